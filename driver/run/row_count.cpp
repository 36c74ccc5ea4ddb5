#include "driver/run/row_count.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

void write_row_count(const std::filesystem::path& file, std::int64_t n_rows) {
  exchange::write_text(
      file, fmt::format("# Written by tanktread: how many rows of observables.csv were due up to this "
                        "checkpoint.\nrows = {}\n",
                        n_rows));
}

std::optional<std::int64_t> read_row_count(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const auto n_rows = toml::parse_file(file.string())["rows"].value<std::int64_t>();
    if (n_rows && *n_rows >= 0) return n_rows;
  } catch (const toml::parse_error& error) {
    throw exchange::FileError(fmt::format("{}: is damaged: {}", file.string(), error.description()));
  }
  throw exchange::FileError(
      fmt::format("{}: rows is not there or is no count: the file is damaged", file.string()));
}

}  // namespace tanktread::driver
