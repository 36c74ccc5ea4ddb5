// The Maxwell element: a dashpot in series with a spring, advanced in time from the increments of its strain.
#pragma once

#include <string>
#include <vector>

namespace tanktread::membrane {

/// One step of a scheme: sigma(t + dt) = decay sigma(t) + gain [eps(t + dt) - eps(t)] (Table 3.2; gain = B
/// mu/dt).
struct MaxwellStep {
  double decay = 0;
  double gain = 0;

  double advance(double stress, double strain_increment) const {
    return decay * stress + gain * strain_increment;
  }
};

/// A scheme of Table 3.2 by its name in the case file. tau = mu/k' is the element's relaxation time.
struct MaxwellScheme {
  std::string name;         ///< "fd", "int1", "int2"
  std::string description;  ///< one line with the formula
  /// @param viscosity mu and stiffness k' of the element as they stand in its law, both positive; time_step
  /// dt > 0
  MaxwellStep (*step)(double viscosity, double stiffness, double time_step);
};

/// fd: central differences of the law (Eq. 2.18). int1, int2: its convolution integral with the strain rate
/// taken as constant over a step, and by the trapezoidal rule (Table 3.2).
const std::vector<MaxwellScheme>& maxwell_schemes();

/// @throws std::invalid_argument that lists the known names
const MaxwellScheme& maxwell_scheme(const std::string& name);

}  // namespace tanktread::membrane
