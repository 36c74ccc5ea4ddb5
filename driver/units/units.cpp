#include "driver/units/units.hpp"

#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

/// @param modulus G of the law, which the numbers of the case are in units of
EnergyModuli energy_moduli(const EnergyCase& energy, double modulus, double radius) {
  EnergyModuli result;
  result.bending_modulus = energy.bending_modulus * modulus * radius * radius;
  result.spontaneous_curvature = energy.spontaneous_curvature / radius;
  result.global_area_modulus = energy.global_area_modulus * modulus;
  result.local_area_modulus = energy.local_area_modulus * modulus;
  result.volume_modulus = energy.volume_modulus * modulus / radius;
  return result;
}

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
    result.energy = energy_moduli(membrane.energy, modulus, capsule.radius);
  } else if (membrane.capillary_modulus == "kappa_b") {
    result.capillary_by_kappa_b = membrane.capillary_number;
    result.energy = energy_moduli(membrane.energy, modulus, capsule.radius);
    result.energy.bending_modulus = modulus * capsule.radius * capsule.radius;
  } else {
    result.shear_modulus = membrane.capillary_modulus == "E_s" ? 0.5 * modulus : modulus;
    result.capillary_by_G_s = viscous / result.shear_modulus;
    result.energy = energy_moduli(membrane.energy, result.shear_modulus, capsule.radius);
    if (membrane.elastic_law == "skalak") {
      result.skalak_modulus = 2.0 * result.shear_modulus;
      result.capillary_by_E_s = viscous / result.skalak_modulus;
    }
  }
  result.viscous = viscous_parameters(membrane.viscous, viscosity, capsule.radius, shear_rate);
  if (membrane.viscous.strain_rates == "nodes") result.rates_at = membrane::RatesAt::nodes;
  result.area_modulus = elastic_law(membrane, result)->area_modulus();
  return result;
}

}  // namespace

Parameters parameters(const Case& the_case) {
  Parameters result{flow_parameters(the_case), {}};
  for (const auto& capsule : the_case.capsules) {
    result.capsules.push_back(capsule_parameters(capsule, result.kinematic_viscosity, result.shear_rate));
  }
  return result;
}

}  // namespace tanktread::driver
