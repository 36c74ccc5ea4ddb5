// What is said of the viscosity of a membrane, explicit (ViscousLaw) or implicit (ImplicitViscosity). Plain
// values apart from the classes, so that who only says them need not compile the mathematics.
#pragma once

#include <string>

namespace tanktread::membrane {

/// Which rate the dashpots see.
enum class StressMeasure {
  rate_of_deformation,  ///< D = F^-T (dE/dt) F^-1, as the shear and dilatation of a fluid surface
  rate_of_strain,       ///< dE/dt in its place, as the thesis writes it
};

/// Which strain enters an update when N > 1.
enum class StrainSampling {
  latest,          ///< that of the step of the update ("sub-sampling")
  moving_average,  ///< the mean of the N strains since the last update (Eqs. 2.36-2.37)
};

/// What a viscous law is made from; lattice units.
struct ViscousParameters {
  std::string scheme = "fd";          ///< of maxwell_schemes()
  double shear_viscosity = 0;         ///< mu_s, 0: none
  double dilatational_viscosity = 0;  ///< mu_d, 0: none
  double shear_spring = 0;            ///< k_s', positive where mu_s is
  double dilatational_spring = 0;     ///< k_d', positive where mu_d is
  int interval = 1;                   ///< N: the stress is updated every N steps, dt = N
  StrainSampling sampling = StrainSampling::latest;
  StressMeasure measure = StressMeasure::rate_of_deformation;
};

/// Where the strain rates are taken.
enum class RatesAt {
  elements,  ///< in each triangle, of its linear velocity field
  nodes,     ///< at each node, the mean of the triangles around
};

/// What an implicit viscosity is made from; lattice units.
struct ImplicitParameters {
  double shear_viscosity = 0;         ///< mu_s, 0: none
  double dilatational_viscosity = 0;  ///< mu_d, 0: none
  /// Relaxation times 2 mu_s/k_s' and 2 mu_d/k_d' of Maxwell elements, steps; 0: no spring.
  double shear_relaxation = 0, dilatational_relaxation = 0;
  RatesAt rates_at = RatesAt::elements;
};

}  // namespace tanktread::membrane
