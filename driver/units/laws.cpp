#include "driver/units/laws.hpp"

#include <algorithm>

#include "driver/units/units.hpp"
#include "membrane/implicit_viscosity.hpp"
#include "membrane/shape.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::driver {
namespace {

/// tau = mu/k' of a part in steps, from the form in which its spring is given; none if it is given in none.
std::optional<double> relaxation_time(const std::optional<double>& stiffness,
                                      const std::optional<double>& shear_times,
                                      const std::optional<double>& modulus, double viscosity,
                                      double shear_rate) {
  if (stiffness) return 2.0 / (*stiffness * shear_rate);
  if (shear_times) return *shear_times / shear_rate;
  if (modulus) return viscosity / *modulus;
  return std::nullopt;
}

/// A term, in the order of the table: its modulus here and there, and what it is at rest.
struct EnergyOfCapsule {
  std::string name;
  double EnergyModuli::*modulus;
  std::string parameter, at_rest;
};

const EnergyOfCapsule energy_list[] = {
    {"bending", &EnergyModuli::bending_modulus, "bending_modulus", "spontaneous_curvature"},
    {"global-area", &EnergyModuli::global_area_modulus, "area_modulus", "reference_area"},
    {"local-area", &EnergyModuli::local_area_modulus, "local_area_modulus", "reference_area"},
    {"volume", &EnergyModuli::volume_modulus, "volume_modulus", "reference_volume"},
};

}  // namespace

std::unique_ptr<membrane::ElasticLaw> elastic_law(const MembraneCase& membrane,
                                                  const CapsuleParameters& capsule) {
  membrane::ElasticParameters law;
  law.shear_modulus = capsule.shear_modulus;
  law.area_ratio = membrane.area_ratio;
  law.poisson_ratio = membrane.poisson_ratio;
  law.interfacial_tension = capsule.interfacial_tension;
  return membrane::make_elastic_law(membrane.elastic_law, law);
}

std::unique_ptr<membrane::EnergyTerms> energy_terms(const MembraneCase& membrane,
                                                    const CapsuleParameters& capsule,
                                                    const membrane::TriangleMesh& start, int threads) {
  if (!capsule.energy.any()) return nullptr;
  const double area = membrane::surface_area(start.points, start.triangles);
  const double volume = membrane::volume_moments(start.points, start.triangles).volume;
  std::vector<membrane::EnergyChoice> choices;
  for (const auto& term : energy_list) {
    if (capsule.energy.*term.modulus == 0) continue;
    auto& parameters = choices.emplace_back(term.name).parameters;
    parameters[term.parameter] = capsule.energy.*term.modulus;
    // What is left out is that of the mesh as the term measures it, so that it rests to the last bit.
    if (term.at_rest == "reference_area" && membrane.energy.reference_area != 1)
      parameters[term.at_rest] = membrane.energy.reference_area * area;
    if (term.at_rest == "reference_volume" && membrane.energy.reference_volume != 1)
      parameters[term.at_rest] = membrane.energy.reference_volume * volume;
    if (term.at_rest == "spontaneous_curvature")
      parameters[term.at_rest] = capsule.energy.spontaneous_curvature;
  }
  return std::make_unique<membrane::EnergyTerms>(start, choices, threads);
}

std::vector<std::string> term_names(const Parameters& parameters) {
  std::vector<std::string> names;
  for (const auto& term : energy_list) {
    if (std::ranges::any_of(parameters.capsules,
                            [&](const CapsuleParameters& c) { return c.energy.*term.modulus > 0; }))
      names.push_back(term.name);
  }
  return names;
}

std::string name_in_files(std::string term) {
  std::ranges::replace(term, '-', '_');
  return term;
}

std::optional<membrane::ViscousParameters> viscous_parameters(const ViscousCase& viscous,
                                                              double outer_viscosity, double radius,
                                                              double shear_rate) {
  const bool has_viscosity = viscous.boussinesq_shear > 0 || viscous.boussinesq_dilatational > 0;
  if (viscous.scheme == "none" || !has_viscosity) return std::nullopt;
  membrane::ViscousParameters result;
  result.scheme = viscous.scheme;
  result.interval = viscous.interval;
  if (viscous.strain_sampling == "moving-average") {
    result.sampling = membrane::StrainSampling::moving_average;
  }
  if (viscous.stress_measure == "rate-of-strain") result.measure = membrane::StressMeasure::rate_of_strain;
  result.shear_viscosity = viscous.boussinesq_shear * outer_viscosity * radius;
  result.dilatational_viscosity = viscous.boussinesq_dilatational * outer_viscosity * radius;
  const auto shear_time = relaxation_time(viscous.spring_stiffness, viscous.spring_relaxation_time,
                                          viscous.spring_modulus, result.shear_viscosity, shear_rate);
  const auto dilatational_time =
      relaxation_time(viscous.spring_stiffness_dilatational, viscous.spring_relaxation_time_dilatational,
                      viscous.spring_modulus_dilatational, result.dilatational_viscosity, shear_rate);
  // The checks of the case see to it that an explicit scheme has a time for each part with a viscosity, and
  // that it is not 0.
  const auto spring_of = [&](double viscosity, const std::optional<double>& time) {
    if (viscosity == 0 || (is_implicit(result) && !time)) return 0.0;
    return viscosity / time.value();
  };
  result.shear_spring = spring_of(result.shear_viscosity, shear_time);
  result.dilatational_spring =
      spring_of(result.dilatational_viscosity, dilatational_time ? dilatational_time : shear_time);
  return result;
}

bool is_implicit(const membrane::ViscousParameters& viscous) {
  return viscous.scheme == implicit_scheme;
}

bool any_implicit(const Case& the_case, const Parameters& parameters) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& viscous = parameters.capsules[k].viscous;
    if (the_case.capsules[k].membrane.command.empty() && viscous && is_implicit(*viscous)) return true;
  }
  return false;
}

std::unique_ptr<membrane::ViscousLaw> viscous_law(const CapsuleParameters& capsule) {
  if (!capsule.viscous || is_implicit(*capsule.viscous)) return nullptr;
  return std::make_unique<membrane::ViscousLaw>(*capsule.viscous);
}

std::unique_ptr<membrane::ImplicitViscosity> implicit_viscosity(const CapsuleParameters& capsule,
                                                                const membrane::TriangleMesh& mesh,
                                                                int threads) {
  if (!capsule.viscous || !is_implicit(*capsule.viscous)) return nullptr;
  const auto& viscous = *capsule.viscous;
  const auto relaxation = [](double viscosity, double spring) {
    return spring > 0 ? 2 * viscosity / spring : 0;
  };
  membrane::ImplicitParameters parameters;
  parameters.shear_viscosity = viscous.shear_viscosity;
  parameters.dilatational_viscosity = viscous.dilatational_viscosity;
  parameters.shear_relaxation = relaxation(viscous.shear_viscosity, viscous.shear_spring);
  parameters.dilatational_relaxation =
      relaxation(viscous.dilatational_viscosity, viscous.dilatational_spring);
  parameters.rates_at = capsule.rates_at;
  return std::make_unique<membrane::ImplicitViscosity>(mesh.triangles, mesh.points.cols(), parameters,
                                                       threads);
}

}  // namespace tanktread::driver
