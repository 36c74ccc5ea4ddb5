// Order of convergence of interpolation in a smooth field, against the moments of docs/kernels.md.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupler_moments.hpp"
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

class CouplerInterpolation : public ::testing::TestWithParam<Kernel> {
 protected:
  void SetUp() override { ASSERT_NE(known_, nullptr) << "no row in tests/unit/coupler_moments.hpp"; }

  /// How much the error of a sine falls short of that of the second moment M2, relatively: q^2/12 M4/M2 with
  /// the wave number q = 2 pi/n. phi falls with distance, so that over all phases the fourth moment M4 is
  /// less than half of (half-width)^2 M2.
  double next_order(int n_nodes) const {
    return std::pow(2.0 * std::numbers::pi / n_nodes * kernel_.half_width, 2) / 24.0;
  }

  /// The same where M2 vanishes (and with it M3) and M4 is the first: q^2/30 M6/M4, with an M6 of at most
  /// (half-width)^2 M4.
  double next_order_of_fourth(int n_nodes) const {
    return std::pow(2.0 * std::numbers::pi / n_nodes * kernel_.half_width, 2) / 30.0;
  }

  bool has_second_moment() const { return known_->second_moment != 0.0; }

  const Kernel& kernel_ = GetParam();
  const Moments* known_ = known_moments_of(GetParam());
};

// The error is u' M1 + u" M2/2 + ..., M1 and M2 the first and the second moment. Without M1 the order from n
// to 2n is off by no more than next_order(n)/ln 2; at n = 128 that is 6e-4 for the half-width 2. (The third
// moment, below 0.1, goes with the third derivative, a quarter of a wave away: the squares of the two add,
// and its is 1e-4 of that of M2.)
//
// Without M2 too, and with an M3 that vanishes, the error is u"" M4/24: the order is 4.
//
// M1, where there is one, is the larger part beyond the n at which q M2/2 = M1 (r.m.s. of both): 109 for
// cosine4. 32 times as far out M2 has 1/32^2 = 1e-3 of the squared error, and at twice that a quarter of it:
// the order is above 1 by 0.5e-3.
TEST_P(CouplerInterpolation, IsOfTheOrderOfItsFirstMomentThatDoesNotVanish) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!has_second_moment()) {
      EXPECT_NEAR(order(kernel_, axis, 128), 4.0, next_order_of_fourth(128) / std::numbers::ln2) << axis;
    } else if (kernel_.first_moment) {
      EXPECT_NEAR(order(kernel_, axis, 128), 2.0, 1e-4 + next_order(128) / std::numbers::ln2) << axis;
    } else {
      const double mean_first = mean_square_root_of_phases(kernel_, first_moment);
      const auto far_out = static_cast<int>(32 * std::numbers::pi * known_->second_moment / mean_first);
      EXPECT_NEAR(order(kernel_, axis, far_out), 1.0, 1e-3) << axis;
    }
  }
}

// A capsule is resolved by 8 to 16 nodes, where the second moment has the say for every kernel that has one.
// What is next to it lowers the order. A first moment does so too: it adds (M1/(q M2/2))^2 to the squared
// error, 0.005 at n = 8 and 0.022 at 16 for cosine4, which takes 0.012 from the order.
TEST_P(CouplerInterpolation, IsOfSecondOrFourthOrderWhereACapsuleIsResolved) {
  const double most = has_second_moment() ? 2.0 : 4.0;
  const double here = has_second_moment() ? next_order(8) : next_order_of_fourth(8);
  const double finer = has_second_moment() ? next_order(16) : next_order_of_fourth(16);
  const double least = most + std::log2((1.0 - here) / (1.0 - finer)) - 0.013;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(order(kernel_, axis, 8), least) << axis;
    EXPECT_LT(order(kernel_, axis, 8), most) << axis;
  }
}

// The size of the error at n = 256: the r.m.s. of M1 and M2 (docs/kernels.md) times q and q^2/2, times that
// of the cosine and the sine; the phases of the grid know nothing of those of the field, so the squares add.
// Corrections are O(q^2) = 6e-4 relatively; the second moments have four digits. Where there is none, M4
// q^4/24.
TEST_P(CouplerInterpolation, ErrorIsThatOfTheMoments) {
  const double wave_number = 2.0 * std::numbers::pi / 256;
  const double by_first = wave_number * mean_square_root_of_phases(kernel_, first_moment);
  const double by_next = has_second_moment() ? std::pow(wave_number, 2) / 2 * known_->second_moment
                                             : std::pow(wave_number, 4) / 24 * known_->fourth_moment;
  const double expected = std::hypot(by_first, by_next) / std::sqrt(2.0);
  EXPECT_NEAR(interpolation_error(kernel_, 0, 256) / expected, 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(All, CouplerInterpolation, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tanktread::coupler
