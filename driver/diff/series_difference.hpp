// Two series (.pvd) compared: which files they name, and at which times.
#pragma once

#include <string>
#include <vector>

#include "driver/diff/difference_report.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// Adds the names and times of two series to the report; the files themselves are not looked at. Entries
/// belong together by the names of their files.
void compare_series(const std::vector<exchange::SeriesEntry>& a, const std::vector<exchange::SeriesEntry>& b,
                    DifferenceReport& report);

/// What a file is called where it is compared: a grid or surface in pieces (.pvti, .pvtu) as one that
/// is whole (.vti, .vtu).
std::string whole_name(const std::string& file);

}  // namespace tanktread::driver
