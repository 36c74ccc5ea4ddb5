#include "driver/case/si_numbers.hpp"

#include <utility>

namespace tanktread::driver {

double physical_reynolds_number(const SiCase& si) {
  return si.density_kg_per_m3 * si.shear_rate_per_s * si.radius_m * si.radius_m / si.viscosity_Pa_s;
}

namespace {

/// The modulus that the capillary number is of, and its name. Without a law the bending modulus makes one.
std::pair<double, const char*> modulus_of(const SiCase& si, double radius_m) {
  if (si.interfacial_tension_N_per_m) return {*si.interfacial_tension_N_per_m, "gamma"};
  if (si.shear_modulus_N_per_m) return {*si.shear_modulus_N_per_m, "G_s"};
  return {si.bending_modulus_J.value_or(0.0) / (radius_m * radius_m), "kappa_b"};
}

void apply_energies(EnergyCase& energy, const SiCase& si, double modulus, double radius_m, bool has_law) {
  // Without a law it is in the capillary number.
  energy.bending_modulus =
      has_law ? si.bending_modulus_J.value_or(0.0) / (modulus * radius_m * radius_m) : 0.0;
  energy.spontaneous_curvature = si.spontaneous_curvature_per_m.value_or(0.0) * radius_m;
  energy.global_area_modulus = si.global_area_modulus_N_per_m.value_or(0.0) / modulus;
  energy.local_area_modulus = si.local_area_modulus_N_per_m.value_or(0.0) / modulus;
  energy.volume_modulus = si.volume_modulus_N_per_m2.value_or(0.0) * radius_m / modulus;
}

}  // namespace

void apply_si(Case& the_case) {
  if (!the_case.si) return;
  const auto& si = *the_case.si;
  const double metres_a_step = si.radius_m / the_case.capsules.front().radius;
  for (auto& capsule : the_case.capsules) {
    if (si.inner_viscosity_Pa_s) capsule.viscosity_ratio = *si.inner_viscosity_Pa_s / si.viscosity_Pa_s;
    auto& membrane = capsule.membrane;
    const double radius_m = capsule.radius * metres_a_step;
    const auto [modulus, name] = modulus_of(si, radius_m);
    membrane.capillary_modulus = name;
    membrane.capillary_number = si.viscosity_Pa_s * si.shear_rate_per_s * radius_m / modulus;
    capsule.load.force = si.load_force_N.value_or(0.0) / (modulus * radius_m);
    apply_energies(membrane.energy, si, modulus, radius_m, membrane.elastic_law != no_elastic_law);
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
