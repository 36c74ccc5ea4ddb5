#include "driver/outside/outside_fluid.hpp"
#include "driver/system/components.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {

fluid::Storage storage_of(const FlowCase& flow) {
  return flow.storage == "single" ? fluid::Storage::single_precision : fluid::Storage::double_precision;
}

double fluid_memory_bytes(const FlowCase& flow) {
  const double n_nodes = 1.0 * flow.box[0] * flow.box[1] * flow.box[2];
  return n_nodes * (fluid::lattice_boltzmann_memory_per_node(storage_of(flow)) +
                    fluid::lattice_boltzmann_force_memory_per_node + fluid::lattice_boltzmann_state_per_node);
}

fluid::LatticeBoltzmannSettings fluid_settings(const Case& the_case, const FlowParameters& parameters) {
  const auto& flow = the_case.flow;
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {flow.box[0], flow.box[1], flow.box[2]};
  settings.relaxation_time = parameters.relaxation_time;
  settings.magic_parameter.reset();
  if (flow.collision == "trt") settings.magic_parameter = flow.magic_parameter;
  settings.inertia = flow.inertia;
  settings.body_force = parameters.body_force;
  settings.storage = storage_of(flow);
  settings.start = flow.start == "developed" ? fluid::Start::developed : fluid::Start::rest;
  settings.speed_limit = parameters.speed_limit;
  settings.threads = the_case.run.threads;
  if (flow.kind != "periodic") {
    fluid::WallPair walls;
    walls.axis = flow.wall_axis;
    if (flow.kind == "shear") {
      walls.low_velocity[flow.flow_axis] = -parameters.wall_speed;
      walls.high_velocity[flow.flow_axis] = parameters.wall_speed;
    }
    settings.walls = walls;
  }
  return settings;
}

std::unique_ptr<fluid::Fluid> make_fluid(const Case& the_case, const FlowParameters& parameters) {
  auto solver = fluid::make_lattice_boltzmann(fluid_settings(the_case, parameters));
  if (the_case.flow.command.empty()) return solver;
  return std::make_unique<OutsideFluid>(the_case, parameters, *solver);
}

}  // namespace tanktread::driver
