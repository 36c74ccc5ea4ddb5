// How many rows a run had written up to a state, so that a resumed run knows whether all are still there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tanktread::driver {

/// The file in a checkpoint that holds it.
inline constexpr const char* row_count_file = "output.toml";

/// @param n_rows of observables.csv that were due up to the state, without those that only the end of a run
/// wrote @throws exchange::FileError
void write_row_count(const std::filesystem::path& file, std::int64_t n_rows);
/// Nothing: there is no such file (a checkpoint of an earlier version). @throws exchange::FileError
std::optional<std::int64_t> read_row_count(const std::filesystem::path& file);

}  // namespace tanktread::driver
