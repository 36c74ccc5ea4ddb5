// parameters.toml: what follows from a case, as a file for other programs.
#pragma once

#include <filesystem>
#include <string>

#include "driver/units/units.hpp"

namespace tanktread::driver {

/// The commit of this program, after those of the programs that made a run so far: "248c18c6a8", or
/// "248c18c6a8, 397a667e11" where this one is another.
/// @param file parameters.toml of the run so far; one that is not there or cannot be read counts as "unknown"
/// @param ours the commit of this program
std::string commits_with(const std::filesystem::path& file, const std::string& ours);

/// All parameters as TOML: the program and its commit (or commits, as above), the numbers of [flow], a
/// [[capsule]] for each; each number with its unit and formula. What a capsule does not have (a modulus, a
/// viscosity) is left out. Real numbers read back to the same double.
std::string parameters_toml(const Parameters& parameters, const std::string& commits);

}  // namespace tanktread::driver
