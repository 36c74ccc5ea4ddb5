#include "driver/case/si_numbers.hpp"

namespace tanktread::driver {

double physical_reynolds_number(const SiCase& si) {
  return si.density_kg_per_m3 * si.shear_rate_per_s * si.radius_m * si.radius_m / si.viscosity_Pa_s;
}

void apply_si(Case& the_case) {
  if (!the_case.si) return;
  const auto& si = *the_case.si;
  const double metres_a_step = si.radius_m / the_case.capsules.front().radius;
  for (auto& capsule : the_case.capsules) {
    if (si.inner_viscosity_Pa_s) capsule.viscosity_ratio = *si.inner_viscosity_Pa_s / si.viscosity_Pa_s;
    auto& membrane = capsule.membrane;
    const double radius_m = capsule.radius * metres_a_step;
    const double modulus =
        si.interfacial_tension_N_per_m ? *si.interfacial_tension_N_per_m : *si.shear_modulus_N_per_m;
    membrane.capillary_modulus = si.interfacial_tension_N_per_m ? "gamma" : "G_s";
    membrane.capillary_number = si.viscosity_Pa_s * si.shear_rate_per_s * radius_m / modulus;
    capsule.load.force = si.load_force_N.value_or(0.0) / (modulus * radius_m);
    const double viscosity_times_radius = si.viscosity_Pa_s * radius_m;
    membrane.viscous.boussinesq_shear =
        si.membrane_shear_viscosity_N_s_per_m.value_or(0.0) / viscosity_times_radius;
    membrane.viscous.boussinesq_dilatational =
        si.membrane_dilatational_viscosity_N_s_per_m.value_or(0.0) / viscosity_times_radius;
  }
  auto& flow = the_case.flow;
  if (flow.kind != "periodic" && !flow.reynolds_number && !flow.wall_speed) {
    flow.reynolds_number = physical_reynolds_number(si);
  }
}

}  // namespace tanktread::driver
