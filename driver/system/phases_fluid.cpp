#include "driver/system/phases.hpp"

namespace tanktread::driver {

GridVectors grid_velocity(const fluid::Fluid& fluid, std::span<const std::int64_t> nodes) {
  GridVectors velocity{{nodes.begin(), nodes.end()}, std::vector<double>(3 * nodes.size())};
  fluid.velocity(nodes, velocity.values);
  return velocity;
}

double advance_fluid(fluid::Fluid& fluid, const GridVectors& force) {
  set_force(fluid, force);
  return fluid.step();
}

void set_force(fluid::Fluid& fluid, const GridVectors& force) {
  fluid.clear_force();
  fluid.add_force(force.nodes, force.values);
}

}  // namespace tanktread::driver
