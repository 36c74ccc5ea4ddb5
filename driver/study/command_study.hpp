// What the commands of the studies have in common.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "driver/program/commands.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/number_option.hpp"
#include "driver/program/output_file.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// "what: name, name ..." of what an option takes.
inline std::string names_text(const std::string& what, const std::vector<std::string>& names) {
  return fmt::format("{}: {}", what, fmt::join(names, ", "));
}

/// --out, the table to write.
inline void add_file_option(CLI::App& command, std::string& file) {
  command.add_option("--out", file, "Table to write (.csv)")->required();
}

/// Writes the table that `make` returns; what the studies refuse is bad input.
/// @param header the table of no study: only such a table is replaced
template <class Make>
void write_table(const std::string& file, const std::string& header, const Make& make) {
  check_output({"--out", file}, table_output(header));
  try {
    exchange::write_text(file, make());
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
  fmt::print("{}\n", file);
}

/// Each study once for each of the values, which `set` puts into it.
template <class Study, class Value, class Set>
std::vector<Study> varied(const std::vector<Study>& studies, const std::vector<Value>& values,
                          const Set& set) {
  std::vector<Study> result;
  for (const Study& study : studies) {
    for (const Value& value : values) set(result.emplace_back(study), value);
  }
  return result;
}

}  // namespace tanktread::driver
