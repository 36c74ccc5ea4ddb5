// From the dimensionless numbers of a case to lattice units.
#pragma once

#include <optional>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/units/flow_units.hpp"
#include "membrane/viscous_parameters.hpp"

namespace tanktread::driver {

/// Moduli of the energies of a whole membrane (docs/energy-terms.md), lattice units; 0: there is none.
struct EnergyModuli {
  double bending_modulus = 0;        ///< kappa_b
  double spontaneous_curvature = 0;  ///< c_0
  double global_area_modulus = 0;    ///< k_A
  double local_area_modulus = 0;     ///< k_d
  double volume_modulus = 0;         ///< k_V

  bool any() const {
    return bending_modulus > 0 || global_area_modulus > 0 || local_area_modulus > 0 || volume_modulus > 0;
  }
};

/// What follows for one capsule, lattice units unless said otherwise.
struct CapsuleParameters {
  double radius = 0;
  double shear_modulus = 0;        ///< G_s; 0 for an interfacial tension, and without a law
  double skalak_modulus = 0;       ///< E_s = 2 G_s (the thesis's form W = E_s/8 ...)
  double area_modulus = 0;         ///< K_s at rest, from the law
  double interfacial_tension = 0;  ///< gamma
  double capillary_by_E_s = 0, capillary_by_G_s = 0,
         capillary_by_gamma = 0;    ///< mu_o g a / modulus; 0 if it has none
  double capillary_by_kappa_b = 0;  ///< mu_o g a^3/kappa_b; without a law, else 0
  EnergyModuli energy;
  double viscosity_ratio = 1;
  std::optional<membrane::ViscousParameters> viscous;        ///< none: no membrane viscosity
  membrane::RatesAt rates_at = membrane::RatesAt::elements;  ///< of an implicit one
};

/// What follows for the flow and for each capsule.
struct Parameters : FlowParameters {
  std::vector<CapsuleParameters> capsules;
};

/// Works out all of the above, the moduli by the elastic laws themselves. Formulas: docs/units.md.
Parameters parameters(const Case& the_case);

}  // namespace tanktread::driver
