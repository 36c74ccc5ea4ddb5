#include "driver/units.hpp"

#include <cmath>

#include "driver/laws.hpp"

namespace tanktread::driver {
namespace {

/// Moduli from Ca = mu_o g a/modulus with mu_o = nu (density 1), and Ca by each modulus the law has.
CapsuleParameters capsule_parameters(const CapsuleCase& capsule, double viscosity, double shear_rate) {
  CapsuleParameters result;
  result.radius = capsule.radius;
  result.viscosity_ratio = capsule.viscosity_ratio;
  const auto& membrane = capsule.membrane;
  const double viscous = viscosity * shear_rate * capsule.radius;
  const double modulus = viscous / membrane.capillary_number;
  if (membrane.capillary_modulus == "gamma") {
    result.interfacial_tension = modulus;
    result.capillary_by_gamma = membrane.capillary_number;
  } else {
    result.shear_modulus = membrane.capillary_modulus == "E_s" ? 0.5 * modulus : modulus;
    result.capillary_by_G_s = viscous / result.shear_modulus;
    if (membrane.elastic_law == "skalak") {
      result.skalak_modulus = 2.0 * result.shear_modulus;
      result.capillary_by_E_s = viscous / result.skalak_modulus;
    }
  }
  result.viscous = viscous_parameters(membrane.viscous, viscosity, capsule.radius, shear_rate);
  result.area_modulus = elastic_law(membrane, result)->area_modulus();
  return result;
}

}  // namespace

Parameters parameters(const Case& the_case) {
  const auto& flow = the_case.flow;
  const double radius = the_case.capsules.front().radius;
  const double height = flow.box[flow.wall_axis];
  Parameters result;
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
  for (const auto& capsule : the_case.capsules) {
    result.capsules.push_back(capsule_parameters(capsule, result.kinematic_viscosity, result.shear_rate));
  }
  return result;
}

}  // namespace tanktread::driver
