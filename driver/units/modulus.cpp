#include "driver/units/modulus.hpp"

namespace tanktread::driver {

double unit_modulus(const CapsuleParameters& capsule) {
  return capsule.interfacial_tension > 0 ? capsule.interfacial_tension : capsule.shear_modulus;
}

}  // namespace tanktread::driver
