// What is known of each kernel without its code: one row a kernel. Every test of the coupler runs with every
// kernel of the library, and one without a row here fails.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler::test {

struct Moments {
  std::string name;
  std::vector<std::array<double, 2>> values;  ///< distance and phi there, by hand
  double first_moment;                        ///< |sum over j of (s - j) phi(s - j)|, the largest of all s
  double even_odd;                            ///< |sum of (-1)^j phi(s - j)|, likewise
  std::array<double, 2> sum_of_squares;       ///< the least and the largest of all s
  double second_moment;                       ///< sum of (s - j)^2 phi(s - j), r.m.s. over all s; four digits
  double fourth_moment;                       ///< sum of (s - j)^4 phi(s - j), likewise
  std::array<double, 2> least;                ///< where phi is least, and phi there; up to there it falls
  /// Mean over all s of the sum over i, j of phi(i - s) phi(j - s) |i - j|/2.
  double shortfall;
};

inline const std::vector<Moments>& known_moments() {
  static const double root2 = std::sqrt(2.0), root7 = std::sqrt(7.0), root13 = std::sqrt(13.0),
                      root231 = std::sqrt(231.0);
  static const std::vector<Moments> rows = {
      // At the phase 0 the quadratic equation has the root 0; at 1/2 it has (sqrt(231) - 21)/224.
      {"stockie6",
       {{0.0, 5.0 / 8.0},
        {0.5, 9.0 / 16.0 + (root231 - 21.0) / 112.0},
        {1.0, 1.0 / 4.0},
        {1.5, -1.0 / 16.0 - 3.0 * (root231 - 21.0) / 224.0},
        {2.0, -1.0 / 16.0},
        {2.5, (root231 - 21.0) / 224.0}},
       0.0,
       0.0,
       {67.0 / 128.0, 67.0 / 128.0},  // 25/64 + 2/16 + 2/256
       0.0,
       1.6756,
       {1.941895, -0.0647725},  // by search outside the project
       0.173756},               // by summation outside the project
      {"peskin4",
       {{0.0, 1.0 / 2.0},
        {0.25, (5.0 + root7) / 16.0},  // (5/2 + sqrt(7/4)) / 8
        {0.5, (2.0 + root2) / 8.0},
        {1.0, 1.0 / 4.0},
        {1.5, (2.0 - root2) / 8.0},
        {1.75, (3.0 - root7) / 16.0}},  // (3/2 - sqrt(7/4)) / 8
       0.0,
       0.0,
       {3.0 / 8.0, 3.0 / 8.0},
       0.5242,
       0.6731,
       {2.0, 0.0},
       0.380992},  // by summation outside the project
      // First moment: s - 1/2 + cos(pi s/2 + pi/4)/sqrt(2) has its extrema where the sine of that angle is
      // 2 sqrt(2)/pi; there it is 0.0210881.
      {"cosine4",
       {{0.0, 1.0 / 2.0},
        {0.5, (2.0 + root2) / 8.0},  // cos(pi/4) = sqrt(2)/2
        {2.0 / 3.0, 3.0 / 8.0},      // cos(pi/3) = 1/2
        {1.0, 1.0 / 4.0},
        {1.5, (2.0 - root2) / 8.0}},
       0.0210881,
       0.0,
       {3.0 / 8.0, 3.0 / 8.0},
       0.5230,
       0.6656,
       {2.0, 0.0},
       // With c and s', cosine and sine of pi s/2, the sum is (4 - c - s' + c s')/8; the means are 2/pi,
       // 2/pi,
       // 1/pi.
       0.5 - 3.0 / (8.0 * std::numbers::pi)},
      // Even-odd: at s = 0 it is 2/3 - 1/3.
      {"roma3",
       {{0.0, 2.0 / 3.0},
        {0.25, (4.0 + root13) / 12.0},  // sqrt(1 - 3/16) = sqrt(13)/4
        {0.5, 1.0 / 2.0},
        {1.0, 1.0 / 6.0},
        {1.25, (5.0 - root13) / 24.0}},  // (5/4 - sqrt(13)/4) / 6
       0.0,
       1.0 / 3.0,
       {1.0 / 2.0, 1.0 / 2.0},
       0.2998,
       0.2407,
       {1.5, 0.0},
       // By the first two moments (1 - w^2 - s^2)/2 with w = (1 + q)/3, q = sqrt(1 - 3 s^2), |s| <= 1/2; the
       // means
       // of q and q^2 are 1/4 + pi/(3 sqrt(3)) and 3/4.
       0.5 - (2.25 + 2.0 * std::numbers::pi / (3.0 * std::sqrt(3.0))) / 18.0 - 1.0 / 24.0},
      // On a node the even-odd sum and that of the squares are 1; half-way between two nodes, 0 and 1/2. The
      // second moment is s (1 - s), its r.m.s. sqrt(1/30).
      {"linear2",
       {{0.0, 1.0}, {0.25, 0.75}, {0.5, 0.5}},
       0.0,
       1.0,
       {1.0 / 2.0, 1.0},
       0.1826,
       0.0690,
       {1.0, 0.0},
       1.0 / 6.0},  // s (1 - s)
  };
  return rows;
}

/// The row of a kernel; null if it has none.
inline const Moments* known_moments_of(const Kernel& kernel) {
  const auto& rows = known_moments();
  const auto found = std::ranges::find(rows, kernel.name, &Moments::name);
  return found == rows.end() ? nullptr : &*found;
}

/// Every phase of the grid; multiples of 2^-10, so that s - j is exact.
inline std::vector<double> phases() {
  std::vector<double> all;
  for (int k = 0; k < 1024; ++k) all.push_back(k / 1024.0);
  return all;
}

/// sum over all grid nodes j of weight(j) phi(s - j); s is the place of a membrane node between nodes 0
/// and 1.
template <class Weight>
double sum_over_nodes(const Kernel& kernel, double s, const Weight& weight) {
  double sum = 0.0;
  for (int j = -3; j <= 4; ++j) sum += weight(j) * kernel.function(s - j);
  return sum;
}

inline double first_moment(const Kernel& kernel, double s) {
  return sum_over_nodes(kernel, s, [s](int j) { return s - j; });
}
inline double second_moment(const Kernel& kernel, double s) {
  return sum_over_nodes(kernel, s, [s](int j) { return (s - j) * (s - j); });
}

inline double fourth_moment(const Kernel& kernel, double s) {
  return sum_over_nodes(kernel, s, [s](int j) { return std::pow(s - j, 4); });
}

/// The largest size, and the root mean square, of a function of kernel and phase over all phases.
template <class Function>
double largest_of_phases(const Kernel& kernel, const Function& function) {
  double largest = 0.0;
  for (const double s : phases()) largest = std::max(largest, std::abs(function(kernel, s)));
  return largest;
}
template <class Function>
double mean_square_root_of_phases(const Kernel& kernel, const Function& function) {
  double sum = 0.0;
  for (const double s : phases()) sum += function(kernel, s) * function(kernel, s);
  return std::sqrt(sum / static_cast<double>(phases().size()));
}

}  // namespace tanktread::coupler::test
