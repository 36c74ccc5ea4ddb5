// parameters.toml: what follows from a case, as a file for other programs.
#pragma once

#include <string>

#include "driver/units.hpp"

namespace tanktread::driver {

/// All parameters as TOML: the program and its commit, the numbers of [flow], a [[capsule]] for each; each
/// number with its unit and formula. What a capsule does not have (a modulus, a viscosity) is left out. Real
/// numbers read back to the same double.
std::string parameters_toml(const Parameters& parameters);

}  // namespace tanktread::driver
