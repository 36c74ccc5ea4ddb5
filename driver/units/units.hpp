// From the dimensionless numbers of a case to lattice units.
#pragma once

#include <optional>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/units/flow_units.hpp"
#include "membrane/viscous_parameters.hpp"

namespace tanktread::driver {

/// What follows for one capsule, lattice units unless said otherwise.
struct CapsuleParameters {
  double radius = 0;
  double shear_modulus = 0;        ///< G_s; 0 for an interfacial tension
  double skalak_modulus = 0;       ///< E_s = 2 G_s (the thesis's form W = E_s/8 ...)
  double area_modulus = 0;         ///< K_s at rest, from the law
  double interfacial_tension = 0;  ///< gamma
  double capillary_by_E_s = 0, capillary_by_G_s = 0,
         capillary_by_gamma = 0;  ///< mu_o g a / modulus; 0 if it has none
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
