#include "driver/units/load_units.hpp"

#include "driver/units/modulus.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {

double load_force(const CapsuleCase& capsule, const CapsuleParameters& parameters) {
  return capsule.load.force * unit_modulus(parameters) * parameters.radius;
}

std::int64_t load_end(const LoadCase& load, const FlowParameters& flow) {
  return load.until ? schedule_of(*load.until, flow).interval : most_steps + 1;
}

}  // namespace tanktread::driver
