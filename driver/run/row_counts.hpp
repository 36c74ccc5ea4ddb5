// How many rows the tables of a run had up to a state, so that a resumed run knows whether all are still
// there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tanktread::driver {

/// Rows that were due up to a state, without those that only the end of a run wrote.
struct RowCounts {
  std::int64_t observables = 0;  ///< of observables.csv
  std::int64_t measures = 0;     ///< of measures.csv
  std::int64_t energy = 0;       ///< of energy.csv
};

/// The file in a checkpoint that holds them. Of a table that has no row it says nothing, but for
/// observables.csv.
inline constexpr const char* row_counts_file = "output.toml";

/// @throws exchange::FileError
void write_row_counts(const std::filesystem::path& file, const RowCounts& counts);
/// Nothing: there is no such file (a checkpoint of an earlier version). @throws exchange::FileError
std::optional<RowCounts> read_row_counts(const std::filesystem::path& file);

}  // namespace tanktread::driver
