// Loads of a capsule in lattice units.
#pragma once

#include <cstdint>

#include "driver/units/units.hpp"

namespace tanktread::driver {

/// F = load.force G a on each patch, G the unit_modulus(). Negative: the ends are pressed together.
double load_force(const CapsuleCase& capsule, const CapsuleParameters& parameters);

/// The first step at whose positions the load is off: load.until as the nearest whole step, at least 1;
/// beyond the end of any run if there is none.
std::int64_t load_end(const LoadCase& load, const FlowParameters& flow);

}  // namespace tanktread::driver
