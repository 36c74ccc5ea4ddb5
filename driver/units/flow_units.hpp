// From the dimensionless numbers of a case to lattice units: what the flow needs.
#pragma once

#include <array>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// What follows for the flow, lattice units unless said otherwise.
struct FlowParameters {
  double kinematic_viscosity = 0;                ///< nu = (tau+ - 1/2)/3
  double relaxation_time = 0;                    ///< tau+
  double relaxation_time_odd = 0;                ///< tau-
  double shear_rate = 0;                         ///< g = 2 U0/L (or given: periodic)
  double wall_speed = 0;                         ///< U0; poiseuille: undisturbed centre speed; periodic: 0
  double reynolds_number = 0;                    ///< g a^2/nu, a of the first capsule
  double mach_number = 0;                        ///< U0 sqrt(3); periodic: g a sqrt(3)
  std::array<double, 3> body_force = {0, 0, 0};  ///< of the kind (poiseuille) and the key together
  double steps_per_shear_time = 0;               ///< 1/g
  double speed_limit = 0.3;                      ///< a fluid that is as fast stops the run
};

/// Works out all of the above. Lattice units: density 1, so that mu_o = nu. Formulas: docs/units.md.
FlowParameters flow_parameters(const Case& the_case);

/// tau+ = 1/2 + 3 lambda nu of the fluid in a capsule.
double inner_relaxation_time(const FlowParameters& flow, double viscosity_ratio);

/// Kinematic viscosities by the mark of a node (GridMarks): that outside, then of each capsule lambda times
/// that.
std::vector<double> viscosities_of_marks(const Case& the_case);

}  // namespace tanktread::driver
