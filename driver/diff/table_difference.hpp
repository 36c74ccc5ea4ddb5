// Two tables (.csv, as observables.csv) compared column by column.
#pragma once

#include <filesystem>

#include "driver/diff/difference_report.hpp"

namespace tanktread::driver {

/// Adds the columns of two tables to the report. The first line that is no comment (#) names the columns;
/// cells end at commas, and the last one of a row at its end. Columns belong together by name, rows by
/// number, from 1; if one table has more rows, those that both have are compared. Cells are compared as text:
/// 1 and 1.0 differ, by 0.
/// @throws exchange::FileError if one cannot be read
void compare_tables(const std::filesystem::path& a, const std::filesystem::path& b, DifferenceReport& report);

}  // namespace tanktread::driver
