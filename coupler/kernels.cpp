// The discrete deltas. Their moments are derived and tabulated in docs/kernels.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "coupler/coupler.hpp"
#include "coupler/products.hpp"

namespace tanktread::coupler {
namespace {

/// Coefficients of t^(2k) in cos(pi t/2), k = 0, ..., 11. The first that is left out is 8e-20.
constexpr std::array<double, 12> quarter_cosine_series = [] {
  std::array<double, 12> series = {1.0};
  for (int k = 1; k < 12; ++k) {
    const double angle_squared = 0.25 * std::numbers::pi * std::numbers::pi;
    series[k] = -series[k - 1] * angle_squared / ((2 * k - 1) * (2 * k));
  }
  return series;
}();

/// cos(pi t/2) for 0 <= t <= 1, to 2e-16; exactly 1 at t = 0. Not by the mathematical library: the compiler
/// makes this for eight coordinates at once, and it does not change with the library.
inline double quarter_cosine(double t) {
  const double square = t * t;
  double sum = quarter_cosine_series.back();
  for (int k = 10; k >= 0; --k) sum = sum * square + quarter_cosine_series[k];
  return sum;
}

/// phi(r) = (1 + cos(pi r / 2)) / 4, |r| <= 2 (Peskin 1977, doi:10.1016/0021-9991(77)90100-0; Eq. 2.2).
double cosine4(double distance) {
  const double r = std::abs(distance);
  if (r >= 2.0) return 0.0;
  return r <= 1.0 ? 0.25 + 0.25 * quarter_cosine(r) : 0.25 - 0.25 * quarter_cosine(2.0 - r);
}

/// The four points of cosine4 are a quarter turn apart: one cosine and one sine serve them all.
void cosine4_weights(int n, const double* first_distances, double* weights) {
  for (int k = 0; k < n; ++k) {
    const double t = first_distances[k] + 2.0;
    const double cosine = 0.25 * quarter_cosine(t), sine = 0.25 * quarter_cosine(1.0 - t);
    weights[4 * k] = 0.25 - cosine;
    weights[4 * k + 1] = 0.25 + sine;
    weights[4 * k + 2] = 0.25 + cosine;
    weights[4 * k + 3] = 0.25 - sine;
  }
}

/// The three-point function (Roma, Peskin and Berger 1999, doi:10.1006/jcph.1999.6293).
double roma3(double distance) {
  const double r = std::abs(distance);
  if (r >= 1.5) return 0.0;
  if (r <= 0.5) return (1.0 + std::sqrt(1.0 - 3.0 * r * r)) / 3.0;
  const double complement = 1.0 - r;
  return (5.0 - 3.0 * r - std::sqrt(1.0 - 3.0 * complement * complement)) / 6.0;
}

/// 1 + 4 r - 4 r^2, and -7 + 12 r - 4 r^2: rounded alike whether the compiler takes one distance or two.
double peskin4_inner(double r) {
  return multiply_add(-4.0 * r, r, 1.0 + 4.0 * r);
}
double peskin4_outer(double r) {
  return multiply_add(-4.0 * r, r, multiply_add(12.0, r, -7.0));
}

/// The four-point function (Peskin 2002, doi:10.1017/S0962492902000077, Sect. 6).
double peskin4(double distance) {
  const double r = std::abs(distance);
  if (r >= 2.0) return 0.0;
  if (r <= 1.0) return (3.0 - 2.0 * r + std::sqrt(peskin4_inner(r))) / 8.0;
  return (5.0 - 2.0 * r - std::sqrt(peskin4_outer(r))) / 8.0;
}

double cosine4_slope(double distance) {
  const double r = std::abs(distance);
  if (r >= 2.0) return 0.0;
  return -std::copysign(std::numbers::pi / 8.0, distance) * quarter_cosine(std::abs(1.0 - r));
}

double roma3_slope(double distance) {
  const double r = std::abs(distance);
  if (r >= 1.5) return 0.0;
  if (r <= 0.5) return -distance / std::sqrt(1.0 - 3.0 * r * r);
  const double complement = 1.0 - r;
  const double slope = -0.5 - 0.5 * complement / std::sqrt(1.0 - 3.0 * complement * complement);
  return std::copysign(slope, -distance);
}

double peskin4_slope(double distance) {
  const double r = std::abs(distance);
  if (r >= 2.0) return 0.0;
  const double slope = r <= 1.0 ? (-1.0 + (1.0 - 2.0 * r) / std::sqrt(peskin4_inner(r))) / 4.0
                                : (-1.0 - (3.0 - 2.0 * r) / std::sqrt(peskin4_outer(r))) / 4.0;
  return distance < 0.0 ? -slope : slope;
}

/// Of the lower and the upper point, at the kinks too: linear fields keep their slope, from either side.
void linear2_slopes(int n, const double* /*first_distances*/, double* slopes) {
  for (int k = 0; k < n; ++k) {
    *slopes++ = 1.0;
    *slopes++ = -1.0;
  }
}

/// Kernel::slopes by a function of one distance.
template <double (*slope)(double), int width>
void slopes_one_by_one(int n, const double* first_distances, double* slopes) {
  for (int k = 0; k < n; ++k) {
    for (int point = 0; point < width; ++point) *slopes++ = slope(first_distances[k] + point);
  }
}

/// The hat function, that is trilinear interpolation (Krueger et al. 2017, doi:10.1007/978-3-319-44649-3,
/// Sect. 11.4).
double linear2(double distance) {
  return std::max(0.0, 1.0 - std::abs(distance));
}

/// The six-point function whose second moment vanishes (Stockie 1997, PhD thesis, University of British
/// Columbia; as in Bao, Kaye and Peskin 2016, doi:10.1016/j.jcp.2016.04.024, with K = 0). Its conditions at
/// the six points of a phase r in (0, 1], the lowest at distance r - 3, leave a quadratic equation for the
/// lowest weight.
inline void stockie6_points(double first_distance, double (&points)[6]) {
  const double r = first_distance + 3.0, r2 = r * r, r3 = r * r2;
  // Written so that all is exact at r = 1, where the last weight must be 0: there a node may just not reach a
  // wall.
  const double b = 2.25 - 1.5 * r2 + (22.0 * r - 7.0 * r3) / 3.0;
  const double g = r2 * (161.0 - 109.0 * r2 + 20.0 * r2 * r2) / 288.0;
  // (-b + sqrt(b^2 - 112 g))/56, without the difference of two nearly equal numbers.
  const double lowest = -2.0 * g / (b + std::sqrt(b * b - 112.0 * g));
  const double even = (r2 - 0.5) / 8.0, odd = (r3 - r) / 12.0;
  points[0] = lowest;
  points[1] = -3.0 * lowest + even + odd;
  points[2] = 2.0 * lowest + 0.25 + (4.0 * r - r3) / 6.0;
  points[3] = 2.0 * lowest + 0.625 - 0.25 * r2;
  points[4] = -3.0 * lowest + 0.25 - (4.0 * r - r3) / 6.0;
  points[5] = lowest + even - odd;
}

/// In blocks, point by point of all coordinates, which the compiler turns into vectors.
void stockie6_weights(int n, const double* first_distances, double* weights) {
  constexpr int block = 64;
  double points[6][block];
  for (int begin = 0; begin < n; begin += block) {
    const int size = std::min(block, n - begin);
    for (int k = 0; k < size; ++k) {
      double of_one[6];
      stockie6_points(first_distances[begin + k], of_one);
      for (int point = 0; point < 6; ++point) points[point][k] = of_one[point];
    }
    for (int k = 0; k < size; ++k) {
      for (int point = 0; point < 6; ++point) *weights++ = points[point][k];
    }
  }
}

double stockie6(double distance) {
  const double r = std::abs(distance);
  if (r >= 3.0) return 0.0;
  // The point at -r is one of the six of its phase: the lowest for r >= 2 and so on.
  const int point = r >= 2.0 ? 0 : r >= 1.0 ? 1 : 2;
  double points[6];
  stockie6_points(-r - point, points);
  return points[point];
}

/// d points/dr of stockie6_points(), by the derivative of their quadratic equation.
inline void stockie6_point_slopes(double first_distance, double (&slopes)[6]) {
  const double r = first_distance + 3.0, r2 = r * r, r3 = r * r2;
  const double b = 2.25 - 1.5 * r2 + (22.0 * r - 7.0 * r3) / 3.0;
  const double db = -3.0 * r + 22.0 / 3.0 - 7.0 * r2;
  const double g = r2 * (161.0 - 109.0 * r2 + 20.0 * r2 * r2) / 288.0;
  const double dg = r * (322.0 - 436.0 * r2 + 120.0 * r2 * r2) / 288.0;
  // The lowest point x solves 28 x^2 + b x + g = 0.
  const double root = std::sqrt(b * b - 112.0 * g), lowest = -2.0 * g / (b + root);
  const double dlowest = -(db * lowest + dg) / root;
  const double even = r / 4.0, odd = (3.0 * r2 - 1.0) / 12.0;
  slopes[0] = dlowest;
  slopes[1] = -3.0 * dlowest + even + odd;
  slopes[2] = 2.0 * dlowest + (4.0 - 3.0 * r2) / 6.0;
  slopes[3] = 2.0 * dlowest - 0.5 * r;
  slopes[4] = -3.0 * dlowest - (4.0 - 3.0 * r2) / 6.0;
  slopes[5] = dlowest + even - odd;
}

void stockie6_slopes(int n, const double* first_distances, double* slopes) {
  for (int k = 0; k < n; ++k) {
    double of_one[6];
    stockie6_point_slopes(first_distances[k], of_one);
    slopes = std::copy_n(of_one, 6, slopes);
  }
}

}  // namespace

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> all = {
      {"stockie6",
       "6 points, square root (Stockie 1997): partition of unity, first and second moment, even-odd "
       "condition, sum of squares 67/128; weights down to -0.065",
       3.0, true, true, stockie6, stockie6_weights, stockie6_slopes},
      {"peskin4",
       "4 points, square roots (Peskin 2002): partition of unity, first moment, even-odd condition, sum of "
       "squares 3/8",
       2.0, true, false, peskin4, nullptr, slopes_one_by_one<peskin4_slope, 4>},
      {"cosine4",
       "(1 + cos(pi r/2))/4, 4 points (Peskin 1977; Eq. 2.2): partition of unity, even-odd condition, sum of "
       "squares 3/8; the first moment does not vanish (at most 0.021)",
       2.0, false, false, cosine4, cosine4_weights, slopes_one_by_one<cosine4_slope, 4>},
      {"roma3",
       "3 points (Roma, Peskin and Berger 1999): partition of unity, first moment, sum of squares 1/2; no "
       "even-odd condition",
       1.5, true, false, roma3, nullptr, slopes_one_by_one<roma3_slope, 3>},
      {"linear2",
       "1 - |r|, 2 points (trilinear interpolation): partition of unity, first moment; no even-odd "
       "condition, "
       "sum of squares between 1/2 and 1",
       1.0, true, false, linear2, nullptr, linear2_slopes},
  };
  return all;
}

const Kernel& kernel(const std::string& name) {
  const auto& all = kernels();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Kernel& k) { return k.name == name; });
  if (found != all.end()) return *found;
  std::string known;
  for (const auto& k : all) known += (known.empty() ? "" : ", ") + k.name;
  throw std::invalid_argument("unknown kernel '" + name + "'; choose from " + known);
}

}  // namespace tanktread::coupler
