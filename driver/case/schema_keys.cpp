#include "driver/case/schema_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver/case/names.hpp"
#include "driver/case/schema_members.hpp"

namespace tanktread::driver {
namespace {

/// "none", "implicit" and the schemes of the Maxwell element; a program that knows no schemes takes any name.
std::vector<std::string> viscous_scheme_names() {
  auto names = maxwell_scheme_names();
  if (!names.empty()) names.insert(names.begin(), {"none", implicit_scheme});
  return names;
}

// Objections: why a key has no place in a case.

std::string refuse_periodic(const Case& the_case, std::size_t) {
  if (the_case.flow.kind != "periodic") return "";
  return "has no meaning in a periodic box, which has no walls; give flow.shear_rate instead";
}

std::string refuse_wall_speed(const Case& the_case, std::size_t capsule) {
  if (the_case.flow.kind == "periodic") return refuse_periodic(the_case, capsule);
  if (!the_case.flow.reynolds_number) return "";
  return "contradicts flow.reynolds_number, for one follows from the other; remove one of them";
}

std::string refuse_shear_rate(const Case& the_case, std::size_t) {
  if (the_case.flow.kind == "periodic") return "";
  return "follows from flow.reynolds_number or flow.wall_speed and is for kind = \"periodic\" only; remove "
         "it";
}

std::string refuse_magic_parameter(const Case& the_case, std::size_t) {
  if (the_case.flow.collision == "trt") return "";
  return "contradicts collision = \"bgk\", which has one relaxation time; remove it, or use \"trt\"";
}

std::string refuse_beside_si(const Case& the_case, std::size_t) {
  if (!the_case.si) return "";
  return "contradicts [si], from which it follows; remove one of them";
}

/// A parameter of some elastic laws only; a program that knows no laws leaves it.
std::string refuse_unless_law_takes(const std::string& parameter, const Case& the_case, std::size_t capsule) {
  const auto& law = the_case.capsules[capsule].membrane.elastic_law;
  const auto takers = elastic_laws_with(parameter);
  if (takers.empty() || std::ranges::find(takers, law) != takers.end()) return "";
  return fmt::format("contradicts elastic_law = \"{}\", which has none (it is of {}); remove it", law,
                     fmt::join(takers, ", "));
}

/// The meaning of a parameter, and the laws that take it (none are known without the membrane component).
std::string with_laws(const std::string& meaning, const std::string& parameter) {
  const auto takers = elastic_laws_with(parameter);
  return takers.empty() ? meaning : fmt::format("{}, {} only", meaning, fmt::join(takers, " and "));
}

std::string refuse_area_ratio(const Case& the_case, std::size_t capsule) {
  return refuse_unless_law_takes("area_ratio", the_case, capsule);
}

std::string refuse_poisson_ratio(const Case& the_case, std::size_t capsule) {
  return refuse_unless_law_takes("poisson_ratio", the_case, capsule);
}

bool is_implicit(const Case& the_case, std::size_t capsule) {
  return the_case.capsules[capsule].membrane.viscous.scheme == implicit_scheme;
}

// Whatever their value: a key that has no place is back at its default when this is asked.
std::string refuse_interval(const Case& the_case, std::size_t capsule) {
  if (!is_implicit(the_case, capsule)) return "";
  return "contradicts scheme = \"implicit\", which finds the viscous stress in every step; remove it";
}

std::string refuse_sampling(const Case& the_case, std::size_t capsule) {
  if (!is_implicit(the_case, capsule)) return "";
  return "contradicts scheme = \"implicit\", which looks at no strain; remove it";
}

std::string refuse_stress_measure(const Case& the_case, std::size_t capsule) {
  if (!is_implicit(the_case, capsule)) return "";
  return "contradicts scheme = \"implicit\", whose stress is of the rate of deformation: with dE/dt the "
         "viscous "
         "force would not be the transpose of the rate, and the equations not symmetric; remove it, or use "
         "scheme = \"fd\"";
}

/// With "none" it has no effect, as the others: so a viscosity can be switched off by its scheme alone.
std::string refuse_unless_implicit(const Case& the_case, std::size_t capsule) {
  const auto& scheme = the_case.capsules[capsule].membrane.viscous.scheme;
  if (scheme == implicit_scheme || scheme == ViscousCase().scheme) return "";
  return "is of scheme = \"implicit\" only; remove it";
}

template <auto member>
using InFlow = InCase<&Case::flow, member>;
template <auto... members>
using InMembrane = InCapsule<&CapsuleCase::membrane, members...>;
template <auto member>
using InEnergy = InMembrane<&MembraneCase::energy, member>;
template <auto member>
using InViscous = InMembrane<&MembraneCase::viscous, member>;

/// Without a law the bending modulus is what Ca is of.
std::string refuse_bending_modulus(const Case& the_case, std::size_t capsule) {
  if (the_case.si) return refuse_beside_si(the_case, capsule);
  if (the_case.capsules[capsule].membrane.elastic_law != no_elastic_law) return "";
  return "contradicts elastic_law = \"none\", whose capillary_number is of kappa_b; remove it";
}

std::vector<Key> energy_keys(const std::string& prefix) {
  using E = EnergyCase;
  return {
      key<InEnergy<&E::bending_modulus>>(prefix + "bending_modulus", "",
                                         "kappa_b/(G a^2), G the modulus of the law (G_s, gamma); 0: none")
          .from(0)
          .unless(refuse_bending_modulus),
      key<InEnergy<&E::spontaneous_curvature>>(prefix + "spontaneous_curvature", "",
                                               "c_0 a; a sphere of the radius has 2")
          .unless(refuse_beside_si),
      key<InEnergy<&E::global_area_modulus>>(prefix + "global_area_modulus", "",
                                             "k_A/G, of the whole area; 0: none")
          .from(0)
          .unless(refuse_beside_si),
      key<InEnergy<&E::local_area_modulus>>(prefix + "local_area_modulus", "",
                                            "k_d/G, of the area of each triangle; 0: none")
          .from(0)
          .unless(refuse_beside_si),
      key<InEnergy<&E::volume_modulus>>(prefix + "volume_modulus", "", "k_V a/G; 0: none")
          .from(0)
          .unless(refuse_beside_si),
      key<InEnergy<&E::reference_area>>(prefix + "reference_area", "",
                                        "area at rest of both area terms, over that of the mesh")
          .above(0),
      key<InEnergy<&E::reference_volume>>(prefix + "reference_volume", "",
                                          "volume at rest of the volume term, over that of the mesh")
          .above(0),
  };
}

std::vector<Key> viscous_keys(const std::string& prefix) {
  using V = ViscousCase;
  return {
      key<InViscous<&V::scheme>>(prefix + "scheme", "", "how the viscous stress is found; none: no viscosity")
          .one_of(viscous_scheme_names()),
      key<InViscous<&V::boussinesq_shear>>(prefix + "boussinesq_shear", "", "Bq_s = mu_s/(mu_o a)")
          .from(0)
          .unless(refuse_beside_si),
      key<InViscous<&V::boussinesq_dilatational>>(prefix + "boussinesq_dilatational", "",
                                                  "Bq_d = mu_d/(mu_o a)")
          .from(0)
          .unless(refuse_beside_si),
      key<InViscous<&V::spring_stiffness>>(
          prefix + "spring_stiffness", "",
          "kappa = L k'/(U0 mu_s) of the artificial spring; one of the three forms, implicit: or none")
          .above(0),
      key<InViscous<&V::spring_relaxation_time>>(prefix + "spring_relaxation_time", "shear times",
                                                 "tau g, tau = mu_s/k'; in place of spring_stiffness")
          .above(0),
      key<InViscous<&V::spring_modulus>>(prefix + "spring_modulus", "lattice",
                                         "k'; in place of spring_stiffness")
          .above(0),
      key<InViscous<&V::spring_stiffness_dilatational>>(
          prefix + "spring_stiffness_dilatational", "",
          "kappa_d = L k_d'/(U0 mu_d); of the three forms none (then tau is that of the shear) or one")
          .above(0),
      key<InViscous<&V::spring_relaxation_time_dilatational>>(prefix + "spring_relaxation_time_dilatational",
                                                              "shear times", "tau_d g, tau_d = mu_d/k_d'")
          .above(0),
      key<InViscous<&V::spring_modulus_dilatational>>(prefix + "spring_modulus_dilatational", "lattice",
                                                      "k_d'")
          .above(0),
      key<InViscous<&V::interval>>(prefix + "interval", "steps",
                                   "N, between two updates of the viscous stress")
          .from(1)
          .to(1'000'000)
          .unless(refuse_interval),
      key<InViscous<&V::strain_sampling>>(prefix + "strain_sampling", "",
                                          "which strain enters an update when N > 1")
          .one_of({"latest", "moving-average"})
          .unless(refuse_sampling),
      key<InViscous<&V::stress_measure>>(
          prefix + "stress_measure", "",
          "the rate that the viscous stress is of: D = F^-T (dE/dt) F^-1, or dE/dt")
          .one_of({"rate-of-deformation", "rate-of-strain"})
          .unless(refuse_stress_measure),
      key<InViscous<&V::strain_rates>>(prefix + "strain_rates", "",
                                       "implicit: of each element, or of the elements around each node")
          .one_of({"elements", "nodes"})
          .unless(refuse_unless_implicit),
  };
}

}  // namespace

std::vector<Key> title_and_flow_keys() {
  using F = FlowCase;
  return {
      key<InCase<&Case::title>>("title", "", "what the case is").free_on_resume(),
      key<InFlow<&F::kind>>("flow.kind", "",
                            "walls that move with -+U0; walls at rest and a body force; no walls")
          .one_of({"shear", "poiseuille", "periodic"}),
      key<InFlow<&F::box>>("flow.box", "grid steps", "fluid nodes along x, y, z; node k sits at k + 1/2")
          .from(4)
          .to(most_nodes_along_axis)
          .required(),
      axis_key<InFlow<&F::wall_axis>>("flow.wall_axis", "normal of the walls, at 0 and at the box's length"),
      axis_key<InFlow<&F::flow_axis>>("flow.flow_axis", "direction of the flow"),
      key<InFlow<&F::reynolds_number>>("flow.reynolds_number", "",
                                       "Re = g a^2/nu, a of the first capsule; or wall_speed")
          .above(0)
          .unless(refuse_periodic),
      key<InFlow<&F::wall_speed>>("flow.wall_speed", "lattice",
                                  "U0 = g L/2 (poiseuille: undisturbed centre speed); or reynolds_number")
          .above(0)
          .unless(refuse_wall_speed),
      key<InFlow<&F::shear_rate>>("flow.shear_rate", "lattice",
                                  "g of a periodic box, where it sets the units only")
          .above(0)
          .unless(refuse_shear_rate),
      key<InFlow<&F::relaxation_time>>("flow.relaxation_time", "steps", "tau+ = 1/2 + 3 nu").above(0.5),
      key<InFlow<&F::collision>>("flow.collision", "", "two relaxation times, or one").one_of({"trt", "bgk"}),
      key<InFlow<&F::magic_parameter>>("flow.magic_parameter", "",
                                       "Lambda = (tau+ - 1/2)(tau- - 1/2), trt only")
          .above(0)
          .unless(refuse_magic_parameter),
      key<InFlow<&F::viscosity_ratio>>("flow.viscosity_ratio", "", "lambda = mu_i/mu_o of all capsules")
          .above(0)
          .unless(refuse_beside_inner_viscosity),
      key<InFlow<&F::start>>("flow.start", "", "fluid at rest, or the steady profile without capsules")
          .one_of({"rest", "developed"}),
      key<InFlow<&F::body_force>>("flow.body_force", "lattice", "force on each node, added"),
      key<InFlow<&F::inertia>>("flow.inertia", "", "false: no quadratic terms (Stokes flow)"),
      key<InFlow<&F::storage>>(
          "flow.storage", "",
          "precision in which the fluid is kept and stepped; forces and membranes: double")
          .one_of({"double", "single"}),
      key<InFlow<&F::speed_limit>>("flow.speed_limit", "lattice", "a fluid that is as fast stops the run")
          .above(0)
          .preset("the less of 0.3 and 5 U0; 0.3 with body_force or in a periodic flow"),
      key<InFlow<&F::command>>("flow.command", "",
                               "a program in the place of the flow solver, and its arguments; []: none"),
  };
}

std::vector<Key> membrane_keys(const std::string& prefix) {
  using M = MembraneCase;
  std::vector<Key> keys = {
      key<InMembrane<&M::elastic_law>>(prefix + "elastic_law", "", "the membrane's law")
          .one_of(elastic_law_names()),
      key<InMembrane<&M::capillary_number>>(prefix + "capillary_number", "",
                                            "Ca = mu_o g a/modulus, a of each capsule; or [si]")
          .above(0)
          .required()
          .unless(refuse_beside_si),
      key<InMembrane<&M::capillary_modulus>>(prefix + "capillary_modulus", "",
                                             "the modulus in Ca: E_s = 2 G_s or G_s (all with shear "
                                             "elasticity), gamma (interfacial-tension), kappa_b/a^2 (none)")
          .one_of({"E_s", "G_s", "gamma", "kappa_b"})
          .preset("by the law")
          .unless(refuse_beside_si),
      key<InMembrane<&M::area_ratio>>(prefix + "area_ratio", "", with_laws("C = E_a/E_s", "area_ratio"))
          .from(0)
          .unless(refuse_area_ratio),
      key<InMembrane<&M::poisson_ratio>>(prefix + "poisson_ratio", "", with_laws("nu_s", "poisson_ratio"))
          .above(-1)
          .below(1)
          .unless(refuse_poisson_ratio),
      key<InMembrane<&M::command>>(
          prefix + "command", "",
          "a program in the place of the membrane's laws, and its arguments; []: none"),
  };
  for (const auto& group : {energy_keys(prefix), viscous_keys(prefix + "viscous.")})
    keys.insert(keys.end(), group.begin(), group.end());
  return keys;
}

}  // namespace tanktread::driver
