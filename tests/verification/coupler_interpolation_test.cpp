// Order of convergence of interpolation in a smooth field, against the moments of docs/kernels.md.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

/// R.m.s. error of interpolating sin(2 pi s / L) along one axis of length L = n_nodes grid steps, at 997
/// evenly spaced points: 997 is prime, so they meet every phase of the grid, evenly.
double interpolation_error(const Kernel& kernel, int axis, int n_nodes) {
  Grid grid = {{6, 6, 6}, {true, true, true}};
  grid.nodes[axis] = n_nodes;
  const double wave_number = 2.0 * std::numbers::pi / n_nodes;
  Numbers positions;
  constexpr int n_points = 997;
  for (int k = 0; k < n_points; ++k) {
    Vector position = {2.3, 3.1, 2.7};
    position[axis] = (k + 0.5) * n_nodes / n_points;
    positions.insert(positions.end(), position.begin(), position.end());
  }
  Coupler coupler(grid, kernel);
  build(coupler, {positions});
  const Numbers field = on_grid_nodes(coupler, grid, [&](const Vector& x) {
    return Vector{std::sin(wave_number * x[axis]), 0.0, 0.0};
  });
  const Numbers velocity = interpolate(coupler, field, {n_points});
  double sum = 0.0;
  for (int k = 0; k < n_points; ++k) {
    const double error = velocity[3 * k] - std::sin(wave_number * positions[3 * k + axis]);
    sum += error * error;
  }
  return std::sqrt(sum / n_points);
}

double order(const Kernel& kernel, int axis, int n_nodes) {
  return std::log2(interpolation_error(kernel, axis, n_nodes) /
                   interpolation_error(kernel, axis, 2 * n_nodes));
}

// With the wave number q = 2 pi/n, the error is u'' M2/2 + O(q^3): M2 is the second moment; the third moments
// of all kernels are below 1. From n to 2n the correction changes the ratio of errors by less than q = 0.05
// relatively at n = 128: the order by less than 0.07.
TEST(CouplerInterpolation, IsOfSecondOrderWithTheFirstMoment) {
  for (const char* name : {"roma3", "peskin4", "linear2"})
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(order(kernel(name), axis, 128), 2.0, 0.07) << name << axis;
}

// cosine4 adds u' M1 with |M1| <= 0.0211. It is the larger part where q < 2 * 0.0151/0.523 (r.m.s. of M1 and
// M2), n > 109. At n = 4096 the rest is (q 0.523/2 / 0.0151)^2 = 7e-4 of the squared error: an order within
// 1e-3 of 1. At n = 8 to 16, which is how a capsule is resolved, the second moment has the say.
TEST(CouplerInterpolation, IsOfFirstOrderInTheEndWithoutTheFirstMoment) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(order(kernel("cosine4"), axis, 4096), 1.0, 0.01) << axis;
    EXPECT_NEAR(order(kernel("cosine4"), axis, 8), 2.0, 0.2) << axis;
  }
}

// The size of the error at n = 256: the r.m.s. over all phases of the second moment (docs/kernels.md) times
// q^2/2 times the r.m.s. of the sine. Corrections are O(q^2) = 6e-4 relatively; the second moments have four
// digits.
TEST(CouplerInterpolation, ErrorIsThatOfTheSecondMoment) {
  const std::map<std::string, double> second_moment = {
      {"roma3", 0.2998}, {"peskin4", 0.5242}, {"linear2", 0.1826}};
  const double wave_number = 2.0 * std::numbers::pi / 256;
  for (const auto& [name, moment] : second_moment) {
    const double expected = 0.5 * wave_number * wave_number * moment / std::sqrt(2.0);
    EXPECT_NEAR(interpolation_error(kernel(name), 0, 256) / expected, 1.0, 2e-3) << name;
  }
}

}  // namespace
}  // namespace tanktread::coupler
