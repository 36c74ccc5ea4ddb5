// The angle of an edge from its sine and cosine.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace tanktread::membrane {

/// atan(u)/u = sum of (-u^2)^k/(2 k + 1), by twos: the coefficients of u^4k are 1/(4 k + 1), those of
/// -u^2 u^4k are 1/(4 k + 3).
inline constexpr int n_arc_terms = 10;

/// The angle in [-pi, pi] whose sine and cosine are given, to 9e-16 (two last places of pi). Not by the
/// mathematical library: the compiler makes this for several edges at once, and it does not change with the
/// library. A fourth of the angle, folded to [0, pi/2], has the tangent u <= tan(pi/8); after 20 terms the
/// series is right to 1.2e-17.
inline double dihedral_angle(double sine, double cosine) {
  const double above = 1.0 + std::abs(cosine);
  const double u = std::abs(sine) / (above + std::sqrt(2.0 * above));
  const double square = u * u, fourth = square * square;
  double even = 1.0 / (4 * n_arc_terms - 3), odd = 1.0 / (4 * n_arc_terms - 1);
  for (int k = n_arc_terms - 2; k >= 0; --k) {
    even = even * fourth + 1.0 / (4 * k + 1);
    odd = odd * fourth + 1.0 / (4 * k + 3);
  }
  const double folded = 4.0 * u * (even - square * odd);
  return std::copysign(cosine < 0.0 ? std::numbers::pi - folded : folded, sine);
}

}  // namespace tanktread::membrane
