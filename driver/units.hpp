// From the dimensionless numbers of a case to lattice units.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "driver/case.hpp"
#include "membrane/viscous_law.hpp"

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
  std::optional<membrane::ViscousParameters> viscous;  ///< none: no membrane viscosity
};

/// What follows for the flow, lattice units unless said otherwise.
struct Parameters {
  double kinematic_viscosity = 0;                ///< nu = (tau+ - 1/2)/3
  double relaxation_time = 0;                    ///< tau+
  double relaxation_time_odd = 0;                ///< tau-
  double shear_rate = 0;                         ///< g = 2 U0/L (or given: periodic)
  double wall_speed = 0;                         ///< U0; poiseuille: undisturbed centre speed; periodic: 0
  double reynolds_number = 0;                    ///< g a^2/nu, a of the first capsule
  double mach_number = 0;                        ///< U0 sqrt(3); periodic: g a sqrt(3)
  std::array<double, 3> body_force = {0, 0, 0};  ///< of the kind (poiseuille) and the key together
  double steps_per_shear_time = 0;               ///< 1/g
  std::vector<CapsuleParameters> capsules;
};

/// Works out all of the above. Lattice units: density 1, so that mu_o = nu. Formulas: docs/units.md.
Parameters parameters(const Case& the_case);

}  // namespace tanktread::driver
