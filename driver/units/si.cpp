#include "driver/units/si.hpp"

#include "driver/case/si_numbers.hpp"
#include "driver/units/load_units.hpp"

namespace tanktread::driver {

std::optional<SiScales> si_scales(const Case& the_case, const Parameters& parameters) {
  if (!the_case.si) return std::nullopt;
  const auto& si = *the_case.si;
  SiScales scales;
  scales.length_m = si.radius_m / the_case.capsules.front().radius;
  scales.time_s = parameters.shear_rate / si.shear_rate_per_s;
  // A force is viscosity length^2/time. The density would do as well only where the physical Reynolds number
  // is run; the viscosity does always, and keeps Ca and Bq.
  scales.force_N =
      si.viscosity_Pa_s / parameters.kinematic_viscosity * scales.length_m * scales.length_m / scales.time_s;
  scales.reynolds_number_physical = physical_reynolds_number(si);
  return scales;
}

namespace {

void put_energies(SiCase& si, const EnergyModuli& energy, const SiScales& scales) {
  const auto put = [](std::optional<double>& value, double lattice, double unit) {
    if (lattice != 0) value = lattice * unit;
  };
  const double area_m2 = scales.length_m * scales.length_m;
  put(si.bending_modulus_J, energy.bending_modulus, scales.force_N * scales.length_m);
  put(si.spontaneous_curvature_per_m, energy.spontaneous_curvature, 1 / scales.length_m);
  put(si.global_area_modulus_N_per_m, energy.global_area_modulus, scales.force_N / scales.length_m);
  put(si.local_area_modulus_N_per_m, energy.local_area_modulus, scales.force_N / scales.length_m);
  put(si.volume_modulus_N_per_m2, energy.volume_modulus, scales.force_N / area_m2);
}

}  // namespace

SiCase si_of(const Case& the_case, const Parameters& parameters, const SiScales& scales) {
  const auto& first = parameters.capsules.front();
  const auto& viscous = the_case.capsules.front().membrane.viscous;
  const double newton_per_metre = scales.force_N / scales.length_m;
  const double pascal_second = scales.force_N * scales.time_s / (scales.length_m * scales.length_m);
  SiCase si;
  si.radius_m = first.radius * scales.length_m;
  si.shear_rate_per_s = parameters.shear_rate / scales.time_s;
  si.viscosity_Pa_s = parameters.kinematic_viscosity * pascal_second;
  if (the_case.si && the_case.si->inner_viscosity_Pa_s)
    si.inner_viscosity_Pa_s = first.viscosity_ratio * si.viscosity_Pa_s;
  // The lattice density is 1; a density is force time^2/length^4.
  si.density_kg_per_m3 = pascal_second * scales.time_s / (scales.length_m * scales.length_m);
  if (first.interfacial_tension > 0) {
    si.interfacial_tension_N_per_m = first.interfacial_tension * newton_per_metre;
  } else if (first.shear_modulus > 0) {
    si.shear_modulus_N_per_m = first.shear_modulus * newton_per_metre;
  }
  put_energies(si, first.energy, scales);
  const double metre_viscosity =
      parameters.kinematic_viscosity * first.radius * pascal_second * scales.length_m;
  if (viscous.boussinesq_shear > 0) {
    si.membrane_shear_viscosity_N_s_per_m = viscous.boussinesq_shear * metre_viscosity;
  }
  if (viscous.boussinesq_dilatational > 0) {
    si.membrane_dilatational_viscosity_N_s_per_m = viscous.boussinesq_dilatational * metre_viscosity;
  }
  if (the_case.si && the_case.si->load_force_N)
    si.load_force_N = load_force(the_case.capsules.front(), first) * scales.force_N;
  return si;
}

}  // namespace tanktread::driver
