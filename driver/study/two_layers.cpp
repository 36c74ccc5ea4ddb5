#include "driver/study/two_layers.hpp"

#include <algorithm>
#include <cmath>

namespace tanktread::driver {

double TwoLayers::compliance(double z) const {
  const double below = std::min(z, sheet), above = z - below;
  return below / viscosity_below + above / viscosity_above;
}

double TwoLayers::compliance_moment(double z) const {
  const double below = std::min(z, sheet), above = z - below;
  return below * below / (2 * viscosity_below) + above * (sheet + 0.5 * above) / viscosity_above;
}

double TwoLayers::stress_at_lower_wall() const {
  return (wall_velocity + force * compliance_moment(height)) / compliance(height);
}

double TwoLayers::velocity(double z) const {
  return stress_at_lower_wall() * compliance(z) - force * compliance_moment(z);
}

double TwoLayers::largest_speed() const {
  const double without_stress = force == 0 ? 0 : stress_at_lower_wall() / force;
  return std::max(std::abs(wall_velocity), std::abs(velocity(std::clamp(without_stress, 0.0, height))));
}

}  // namespace tanktread::driver
