// The modulus of a capsule that its other moduli and its forces are in units of.
#pragma once

#include "driver/units/units.hpp"

namespace tanktread::driver {

/// G, lattice units: G_s of a law with shear elasticity, gamma of an interfacial tension, kappa_b/a^2 without a
/// law.
double unit_modulus(const CapsuleParameters& capsule);

}  // namespace tanktread::driver
