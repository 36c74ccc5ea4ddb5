// The Maxwell element by itself: the shear part of membrane::ViscousLaw under a prescribed strain.
#pragma once

#include <string>
#include <vector>

namespace tanktread::driver {

/// A dashpot mu in series with a spring k' under eps(t) = eps0 (1 - cos(2 pi t/T0)) (Eqs. 2.28, 3.31), free
/// of stress at t = 0. Any consistent units; the defaults are those of Sect. 3.4.1 of the thesis.
struct MaxwellStudy {
  std::string scheme = "fd";    ///< of membrane::maxwell_schemes()
  double viscosity = 100;       ///< mu, force times time
  double stiffness = 1;         ///< k', force
  double strain_amplitude = 1;  ///< eps0
  double period = 600;          ///< T0
  double time_step = 1;         ///< dt, from T0/most_steps to T0/2

  static constexpr double most_steps = 1e7;  ///< in a period: the stress of each is kept

  double relaxation_time() const { return viscosity / stiffness; }  ///< tau = mu/k'
};

/// Exact stress of the element (Eq. 3.32).
double exact_stress(const MaxwellStudy& study, double time);

/// Stress of the dashpot alone, the limit k' to infinity (Eq. 3.33).
double dashpot_stress(const MaxwellStudy& study, double time);

/// Stress of the element by the library's law, at dt, 2 dt ... to the end of the first period. The law counts
/// time in its own steps, so mu enters in force times steps; it is driven through E12 with the rate of
/// strain, and its shear part has the viscosity 2 mu_s, so that mu_s = mu/2.
/// @throws std::invalid_argument naming the parameter that is out of range
std::vector<double> computed_stress(const MaxwellStudy& study);

/// Relative discrepancies (Eq. 3.34): square roots of quotients of sums over the steps of the first period.
struct MaxwellErrors {
  double artificial = 0;  ///< L0: exact stress of the element against the dashpot
  double scheme = 0;      ///< L1: computed against exact stress of the element (Sect. 2.3.1 calls it L2)
  double overall = 0;     ///< L2: computed stress against the dashpot
};

/// @throws std::invalid_argument as computed_stress()
MaxwellErrors maxwell_errors(const MaxwellStudy& study);

/// The table of `tanktread study maxwell`, as CSV: a row a study, its parameters and errors.
/// @throws std::invalid_argument as computed_stress()
std::string maxwell_table(const std::vector<MaxwellStudy>& studies);

}  // namespace tanktread::driver
