#include "driver/units/modulus.hpp"

namespace tanktread::driver {

double unit_modulus(const CapsuleParameters& capsule) {
  if (capsule.interfacial_tension > 0) return capsule.interfacial_tension;
  if (capsule.shear_modulus > 0) return capsule.shear_modulus;
  return capsule.energy.bending_modulus / (capsule.radius * capsule.radius);
}

}  // namespace tanktread::driver
