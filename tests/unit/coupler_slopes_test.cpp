// The slopes of the discrete deltas: what they sum to, and that they are those of the function.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupler_moments.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::slopes_test {
namespace {

using namespace test;

// Rounding in one slope: some twenty operations on numbers that are at most 33 (b^2 of stockie6) before they
// are divided by 5 (what is left under its root) or more: 20 * 33/5 eps/2 = 66 eps. A sum of six, each with a
// factor of at most 3.
constexpr double slope_bound = 66 * eps;
constexpr double sum_bound = 18 * slope_bound;

class CouplerSlopes : public ::testing::TestWithParam<Kernel> {
 protected:
  void SetUp() override { ASSERT_NE(kernel_.slopes, nullptr); }

  std::size_t width() const { return static_cast<std::size_t>(std::ceil(2.0 * kernel_.half_width)); }
  /// Distance of the lowest point of a phase, 0 <= phase < 1; those of all phases cover the kernel.
  double first_distance(double phase) const { return 1.0 - kernel_.half_width - phase; }
  Numbers slopes_at(double phase) const {
    const double first = first_distance(phase);
    Numbers slopes(width(), std::nan(""));
    kernel_.slopes(1, &first, slopes.data());
    return slopes;
  }

  const Kernel& kernel_ = GetParam();
};
INSTANTIATE_TEST_SUITE_P(All, CouplerSlopes, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

// Parts of a grid, and threads, ask for other numbers of coordinates at once: none may be rounded otherwise.
TEST_P(CouplerSlopes, DoNotDependOnHowManyAreAskedForAtOnce) {
  const Numbers phases = random_numbers(65, 0, 1, 7);
  for (const std::size_t n : {2, 3, 5, 7, 64, 65}) {
    Numbers first;
    for (std::size_t k = 0; k < n; ++k) first.push_back(first_distance(phases[k]));
    Numbers weights(n * width()), slopes(n * width());
    if (kernel_.weights) kernel_.weights(static_cast<int>(n), first.data(), weights.data());
    kernel_.slopes(static_cast<int>(n), first.data(), slopes.data());
    for (std::size_t k = 0; k < n; ++k) {
      Numbers weights_alone(width()), slopes_alone(width());
      if (kernel_.weights) kernel_.weights(1, &first[k], weights_alone.data());
      kernel_.slopes(1, &first[k], slopes_alone.data());
      for (std::size_t point = 0; point < width(); ++point) {
        EXPECT_EQ(weights[k * width() + point], weights_alone[point]) << n << " at once, number " << k;
        EXPECT_EQ(slopes[k * width() + point], slopes_alone[point]) << n << " at once, number " << k;
      }
    }
  }
}

// Constant fields have no slope: the derivative of the partition of unity.
TEST_P(CouplerSlopes, SumToZero) {
  for (const double phase : phases()) {
    double sum = 0;
    for (const double slope : slopes_at(phase)) sum += slope;
    EXPECT_NEAR(sum, 0, sum_bound) << phase;
  }
}

// A point at the distance r = j - s has the slope d phi/dr. Where the sum of r phi is zero at every phase its
// derivative is so too: the sum of phi + r d phi/dr. So that of (s - j) d phi/dr is +1. For cosine4, whose
// first moment is t - 1/2 + cos(pi t/2 + pi/4)/sqrt(2), it is up to pi/(2 sqrt(2)) = 1.1107, at the phase
// 1/2, and down to pi/4 = 0.7854, at the phase 0.
TEST_P(CouplerSlopes, GiveLinearFieldsTheirSlopeJustWithTheFirstMoment) {
  double least = 2, largest = 0;
  for (const double phase : phases()) {
    const Numbers slopes = slopes_at(phase);
    double sum = 0;
    for (std::size_t k = 0; k < slopes.size(); ++k)
      sum -= (first_distance(phase) + static_cast<double>(k)) * slopes[k];
    least = std::min(least, sum);
    largest = std::max(largest, sum);
  }
  if (kernel_.first_moment) {
    EXPECT_NEAR(least, 1, sum_bound);
    EXPECT_NEAR(largest, 1, sum_bound);
  } else {
    ASSERT_EQ(kernel_.name, "cosine4");
    EXPECT_NEAR(least, std::numbers::pi / 4, sum_bound);
    EXPECT_NEAR(largest, std::numbers::pi / (2 * std::sqrt(2.0)), sum_bound);
  }
}

/// Phases at least 1/128 away from the kinks of all kernels, which are at multiples of 1/2.
Numbers phases_off_kinks() {
  Numbers all;
  for (int k = 0; k < 64; ++k) all.push_back((k + 0.5) / 64);
  return all;
}

// The error of the difference over h is a third of its change to that over 2 h; all of the change is allowed,
// and where that is zero by chance, four times the next term, h^4/120 of the fifth derivative, which near the
// kinks of roma3 is up to 2e5: 7e-9. Rounding: two values, each right to 2 eps, over 2 h.
TEST_P(CouplerSlopes, AreTheDerivativeOfTheFunction) {
  constexpr double h = 1.0 / 1024.0;
  const auto difference = [&](double r, double step) {
    return (kernel_.function(r + step) - kernel_.function(r - step)) / (2 * step);
  };
  double steepest = 0;
  for (const double phase : phases_off_kinks()) {
    const Numbers slopes = slopes_at(phase);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const double r = first_distance(phase) + static_cast<double>(k);
      const double over_h = difference(r, h), over_2h = difference(r, 2 * h);
      EXPECT_NEAR(slopes[k], over_h, std::abs(over_2h - over_h) + 7e-9 + 2 * eps / h) << r;
      steepest = std::max(steepest, std::abs(slopes[k]));
    }
  }
  EXPECT_GT(steepest, 0.35);  // no kernel falls from 1/2 or more to 0 within its reach any flatter
}

TEST_P(CouplerSlopes, AreOddAsTheFunctionIsEven) {
  for (const double phase : phases_off_kinks()) {
    const Numbers here = slopes_at(phase), mirrored = slopes_at(1 - phase);
    for (std::size_t k = 0; k < width(); ++k)
      EXPECT_NEAR(here[k], -mirrored[width() - 1 - k], 2 * slope_bound) << phase << " " << k;
  }
}

TEST_P(CouplerSlopes, OfAllAtOnceAreThoseOneByOne) {
  Numbers first_distances;
  for (const double phase : phases()) first_distances.push_back(first_distance(phase));
  Numbers all(width() * first_distances.size() + 1, 7.0);
  kernel_.slopes(static_cast<int>(first_distances.size()), first_distances.data(), all.data());
  for (std::size_t k = 0; k < first_distances.size(); ++k) {
    const Numbers one = slopes_at(phases()[k]);
    for (std::size_t point = 0; point < width(); ++point) EXPECT_EQ(all[width() * k + point], one[point]);
  }
  EXPECT_EQ(all.back(), 7.0) << "written beyond the last";
}

}  // namespace
}  // namespace tanktread::coupler::slopes_test
