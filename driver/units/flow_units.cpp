#include "driver/units/flow_units.hpp"

#include <algorithm>
#include <cmath>

namespace tanktread::driver {

namespace {

/// A flow that walls or a pressure gradient drive is nowhere five times as fast as they make it: a membrane
/// then moves by itself, as where its springs are too stiff for the time step, and may go on so without ever
/// reaching the first limit. (So does, for once, a capsule that starts far from its shape at rest, at a small
/// capillary number: that is for the case to say.)
double preset_speed_limit(const FlowCase& flow, double wall_speed) {
  constexpr double of_the_lattice = 0.3, wall_speeds = 5;
  const bool nothing_else = flow.kind != "periodic" && flow.body_force == std::array<double, 3>{};
  return nothing_else ? std::min(of_the_lattice, wall_speeds * wall_speed) : of_the_lattice;
}

}  // namespace

FlowParameters flow_parameters(const Case& the_case) {
  const auto& flow = the_case.flow;
  const double radius = the_case.capsules.front().radius;
  const double height = flow.box[flow.wall_axis];
  FlowParameters result;
  result.relaxation_time = flow.relaxation_time;
  result.kinematic_viscosity = (flow.relaxation_time - 0.5) / 3.0;
  result.relaxation_time_odd = flow.collision == "bgk"
                                   ? flow.relaxation_time
                                   : 0.5 + flow.magic_parameter / (flow.relaxation_time - 0.5);
  if (flow.kind == "periodic") {
    result.shear_rate = *flow.shear_rate;
  } else if (flow.wall_speed) {
    result.wall_speed = *flow.wall_speed;
    result.shear_rate = 2.0 * result.wall_speed / height;
  } else {
    result.shear_rate = *flow.reynolds_number * result.kinematic_viscosity / (radius * radius);
    result.wall_speed = 0.5 * result.shear_rate * height;
  }
  result.reynolds_number = result.shear_rate * radius * radius / result.kinematic_viscosity;
  result.mach_number =
      std::sqrt(3.0) * (flow.kind == "periodic" ? result.shear_rate * radius : result.wall_speed);
  result.body_force = flow.body_force;
  if (flow.kind == "poiseuille") {
    result.body_force[flow.flow_axis] +=
        8.0 * result.kinematic_viscosity * result.wall_speed / (height * height);
  }
  result.steps_per_shear_time = 1.0 / result.shear_rate;
  result.speed_limit = flow.speed_limit.value_or(preset_speed_limit(flow, result.wall_speed));
  return result;
}

double inner_relaxation_time(const FlowParameters& flow, double viscosity_ratio) {
  return 0.5 + 3.0 * viscosity_ratio * flow.kinematic_viscosity;
}

std::vector<double> viscosities_of_marks(const Case& the_case) {
  const double outer = flow_parameters(the_case).kinematic_viscosity;
  std::vector<double> viscosities = {outer};
  for (const auto& capsule : the_case.capsules) viscosities.push_back(capsule.viscosity_ratio * outer);
  return viscosities;
}

}  // namespace tanktread::driver
