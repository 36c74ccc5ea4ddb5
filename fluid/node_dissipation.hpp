// The power that viscosity takes from the flow on a node, from the populations that come in. Internal to
// fluid/.
#pragma once

#include <array>

#include "fluid/d3q19.hpp"

namespace tanktread::fluid {

/// 2 mu S:S of a node. With the departure of the populations from equilibrium and the force F (Guo et al.
/// 2002)
///
///   Pi = sum_i (f_i - f_i^eq) c_i c_i + (u F + F u)/2 = -2/3 rho tau S,   mu = rho (tau - 1/2)/3,
///   2 mu S:S = 9 (tau - 1/2)/(6 rho tau^2) Pi:Pi.
///
/// Without inertia rho = 1 and the terms in u F and u u are left out. S has its trace.
/// @param f that come in, less the weights
/// @param force all that acts on the node
/// @param even_rate 1/tau+
inline double dissipation_of_node(const std::array<double, d3q19::n_directions>& f,
                                  const std::array<double, 3>& force, double even_rate, bool inertia) {
  double density_change = f[0];
  std::array<double, 3> momentum = {0.5 * force[0], 0.5 * force[1], 0.5 * force[2]};
  std::array<std::array<double, 3>, 3> pi{};
  // Unrolled, so that products with 0 and 1 go.
#pragma GCC unroll 9
  for (int k = 0; k < d3q19::n_pairs; ++k) {
    const auto& c = d3q19::velocity[2 * k + 1];
    const double even = f[2 * k + 1] + f[2 * k + 2], odd = f[2 * k + 1] - f[2 * k + 2];
    density_change += even;
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
      if (c[a] == 0) continue;
      momentum[a] += c[a] * odd;
#pragma GCC unroll 3
      for (int b = 0; b < 3; ++b)
        if (c[b] != 0) pi[a][b] += c[a] * c[b] * even;
    }
  }
  const double density = inertia ? 1.0 + density_change : 1.0;
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      double part = pi[a][b];
      if (a == b) part -= density_change / d3q19::inverse_sound_speed_squared;
      if (inertia) {
        part -= momentum[a] * momentum[b] / density;
        part += 0.5 * (momentum[a] * force[b] + momentum[b] * force[a]) / density;
      }
      sum += part * part;
    }
  }
  return 1.5 * even_rate * (1.0 - 0.5 * even_rate) * sum / density;
}

}  // namespace tanktread::fluid
