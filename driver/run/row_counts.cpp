#include "driver/run/row_counts.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

constexpr const char* observables_key = "rows";
constexpr const char* measures_key = "measures_rows";
constexpr const char* energy_key = "energy_rows";

/// @throws exchange::FileError for what is no count
std::int64_t count_of(const toml::table& table, const char* key, const std::filesystem::path& file) {
  const auto n_rows = table[key].value<std::int64_t>();
  if (n_rows && *n_rows >= 0) return *n_rows;
  throw exchange::FileError(
      fmt::format("{}: {} is not there or is no count: the file is damaged", file.string(), key));
}

std::int64_t count_if_there(const toml::table& table, const char* key, const std::filesystem::path& file) {
  return table.contains(key) ? count_of(table, key, file) : 0;
}

}  // namespace

void write_row_counts(const std::filesystem::path& file, const RowCounts& counts) {
  auto text = fmt::format(
      "# Written by tanktread: how many rows of observables.csv were due up to this "
      "checkpoint.\n{} = {}\n",
      observables_key, counts.observables);
  if (counts.measures > 0) text += fmt::format("{} = {}\n", measures_key, counts.measures);
  if (counts.energy > 0) text += fmt::format("{} = {}\n", energy_key, counts.energy);
  exchange::write_text(file, text);
}

std::optional<RowCounts> read_row_counts(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const auto table = toml::parse_file(file.string());
    return RowCounts{count_of(table, observables_key, file), count_if_there(table, measures_key, file),
                     count_if_there(table, energy_key, file)};
  } catch (const toml::parse_error& error) {
    throw exchange::FileError(fmt::format("{}: is damaged: {}", file.string(), error.description()));
  }
}

}  // namespace tanktread::driver
