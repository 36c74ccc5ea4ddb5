// Two surface or two grid files compared array by array, with the places where they differ.
#pragma once

#include <filesystem>

#include "driver/diff/difference_report.hpp"

namespace tanktread::driver {

/// Adds all arrays of two .vtu or two .vti files, or of their like in pieces (.pvtu, .pvti), to the report.
/// Files of other programs are read too: numbers of other types are widened to double, text is left out.
/// @throws exchange::FileError if one cannot be read
void compare_surfaces(const std::filesystem::path& a, const std::filesystem::path& b,
                      DifferenceReport& report);
void compare_grids(const std::filesystem::path& a, const std::filesystem::path& b, DifferenceReport& report);

}  // namespace tanktread::driver
