#include <utility>

#include "driver/system/phases.hpp"

namespace tanktread::driver {

GridVectors grid_velocity(const fluid::Fluid& fluid, NodeList nodes, GridVectors memory) {
  memory.values.resize(3 * nodes->size());
  fluid.velocity(*nodes, memory.values);
  return {std::move(nodes), std::move(memory.values), {}};
}

GridVectors free_velocity(const fluid::Fluid& fluid, NodeList nodes, GridVectors memory) {
  memory.values.resize(3 * nodes->size());
  memory.mobility.resize(nodes->size());
  fluid.free_velocity(*nodes, memory.values, memory.mobility);
  return {std::move(nodes), std::move(memory.values), std::move(memory.mobility)};
}

double advance_fluid(fluid::Fluid& fluid, const GridVectors& force) {
  set_force(fluid, force);
  return fluid.step();
}

void set_viscosity(fluid::Fluid& fluid, const GridMarks& marks, std::span<const double> of_marks) {
  std::vector<double> viscosity;
  viscosity.reserve(marks.capsule.size());
  for (const auto mark : marks.capsule) viscosity.push_back(of_marks[static_cast<std::size_t>(mark)]);
  fluid.set_viscosity(*marks.nodes, viscosity);
}

void set_force(fluid::Fluid& fluid, const GridVectors& force) {
  fluid.clear_force();
  fluid.add_force(*force.nodes, force.values);
}

}  // namespace tanktread::driver
