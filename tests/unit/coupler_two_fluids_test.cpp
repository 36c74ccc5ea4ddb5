// Surfaces between two fluids: the length of their shear dipole, and what their nodes lose all the same.
#include "coupler/two_fluids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;
using ::testing::HasSubstr;

class TwoFluids : public ::testing::TestWithParam<Kernel> {
 protected:
  double length(double outer, double inner) const { return dipole_length(GetParam(), {outer, inner}); }
  double shortfall(double outer, double inner, double d) const {
    return tangential_shortfall(GetParam(), {outer, inner}, d);
  }
};
INSTANTIATE_TEST_SUITE_P(All, TwoFluids, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

// Rounding: 1024 phases of some tens of terms up to 1, their sum divided by 1024.
constexpr double rounding = 1e3 * eps;

TEST_P(TwoFluids, OfEqualViscositiesNeedNoDipole) {
  for (const double viscosity : {1e-3, 0.2, 1e3}) EXPECT_EQ(length(viscosity, viscosity), 0) << viscosity;
}

TEST_P(TwoFluids, NeedTheOppositeDipoleIfTheyChangeSides) {
  EXPECT_GT(length(2, 1), 0) << "towards the more viscous fluid";
  for (const double ratio : {1.01, 3.0, 20.0, 100.0, 1000.0})
    EXPECT_NEAR(length(ratio, 1), -length(1, ratio), 1e5 * eps) << ratio;  // bisection of flat sums
}

TEST_P(TwoFluids, NeedADipoleThatGoesWithTheContrast) {
  const double of_contrast = length(1.5, 0.5) / 0.5;  // (1.5 - 0.5)/(1.5 + 0.5)
  for (const double ratio : {1.01, 1.5, 5.0, 10.0, 20.0}) {
    const double contrast = (ratio - 1) / (ratio + 1);
    EXPECT_NEAR(length(ratio, 1), of_contrast * contrast, 8 * eps) << ratio;
    EXPECT_NEAR(length(0.3 * ratio, 0.3), length(ratio, 1), 100 * eps)
        << "0.01 is the difference of numbers near 1";
    EXPECT_EQ(length(4 * ratio, 4), length(ratio, 1));
  }
}

/// <|r + b|> by another way: with |x| = integral over t of (1 - exp(-t^2 x^2))/t^2 / sqrt(pi) it needs the
/// mean of exp(-t^2 (r + b)^2) along one axis only, whose cube is that in three dimensions. t = v/(1 - v).
double mean_distance(const Kernel& kernel) {
  constexpr int cells = 256;  // a grid step
  Numbers density;            // of r + b
  for (int i = 0; i < (kernel.half_width + 0.5) * cells; ++i) {
    double sum = 0;
    for (int j = 0; j < cells; ++j)
      sum += kernel.function((i + 0.5) / cells - 0.5 + (j + 0.5) / cells) / cells;
    density.push_back(sum);
  }
  constexpr int n = 200;
  double integral = 0;
  for (int k = 0; k < n; ++k) {
    const double v = (k + 0.5) / n, t = v / (1 - v);
    double of_axis = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
      const double x = (static_cast<double>(i) + 0.5) / cells;
      of_axis += 2 * density[i] * std::exp(-t * t * x * x) / cells;
    }
    integral += (1 - of_axis * of_axis * of_axis) / (v * v) / n;
  }
  return integral / std::sqrt(std::numbers::pi);
}

// The library's sum has cells of h = 1/24. Trapezoids over b make the mean square of r + b along an axis
// larger by h^2/6 = 2.9e-4, and those over the kinks of linear2 by h^2/12 more: 4.3e-4. The mean of |r + b|
// grows by that times the mean of 1/|r + b|, which is below 1.8, and m by a quarter of it: 2e-4. The
// quadrature above: 1/(24 200^2) and 1/(24 256^2) times second derivatives of some units, 1e-5 of them.
TEST_P(TwoFluids, NeedADipoleOfTheMeanDistance) {
  const double m = length(1.5, 0.5) / (2 * 0.5);
  EXPECT_NEAR(m, mean_distance(GetParam()) / 4, 2e-4);
}

// (1e-3 .. 1e3: thirteen ratios.) The length is that of the contrast, or that which makes the shortfall 0.
TEST_P(TwoFluids, NeverFallShortByLessThanNothing) {
  const double of_contrast = length(1.5, 0.5) / 0.5;
  int n_shorter = 0;
  for (int k = -6; k <= 6; ++k) {
    const double ratio = std::pow(10, 0.5 * k), d = length(ratio, 1);
    const double whole = of_contrast * (ratio - 1) / (ratio + 1);
    EXPECT_GE(shortfall(ratio, 1, d), 0) << ratio;
    EXPECT_LE(std::abs(d), std::abs(whole) + 8 * eps) << ratio;
    if (std::abs(d) > std::abs(whole) - 100 * eps) continue;
    ++n_shorter;
    EXPECT_LT(shortfall(ratio, 1, (1 + 1e-6) * d), 0) << ratio << ": it might be longer";
    EXPECT_LT(shortfall(ratio, 1, whole), 0) << ratio;
  }
  EXPECT_LE(n_shorter, 8);  // not those of up to 10
}

TEST_P(TwoFluids, WithoutADipoleFallShortAsTheMeanOfBoth) {
  const double one = tangential_shortfall(GetParam());
  for (const double viscosity : {0.05, 1.0, 7.0})
    EXPECT_NEAR(shortfall(viscosity, viscosity, 0) * viscosity, one, rounding) << viscosity;
  for (const double ratio : {1e-3, 0.2, 5.0, 1e3}) {
    const double mean = 0.5 * (1 + 1 / ratio);
    EXPECT_NEAR(shortfall(ratio, 1, 0) / mean, one, rounding) << ratio;
  }
}

TEST_P(TwoFluids, FallShortByTheSameIfTheyAndTheDipoleChangeSides) {
  for (const double ratio : {1.0, 3.0, 1e3}) {
    for (const double d : {0.1, -0.3}) {
      EXPECT_NEAR(shortfall(ratio, 1, d), shortfall(1, ratio, -d), rounding) << ratio << " " << d;
      EXPECT_NEAR(shortfall(5 * ratio, 5, d) * 5, shortfall(ratio, 1, d), rounding) << ratio << " " << d;
    }
  }
  // Of equal fluids either way, by a part of second order that makes it less.
  const double plain = shortfall(1, 1, 0), one = plain - shortfall(1, 1, 0.1),
               two = plain - shortfall(1, 1, 0.2);
  EXPECT_GT(one, 1e-3);
  EXPECT_NEAR(two, 4 * one, 8 * rounding);
}

TEST(TwoFluidsRefusals, RefuseViscositiesThatAreNotPositive) {
  const Kernel& first = kernels().front();
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const SideViscosities& sides : {SideViscosities{bad, 1}, SideViscosities{1, bad}}) {
      EXPECT_THAT(complaint([&] { dipole_length(first, sides); }), HasSubstr("must be positive")) << bad;
      EXPECT_THAT(complaint([&] { tangential_shortfall(first, sides, 0); }), HasSubstr("must be positive"));
    }
  }
}

TEST(TwoFluidsRefusals, RefuseAKernelWithoutSlopesOnlyForADipole) {
  Kernel plain = kernel("roma3");
  plain.name = "plain";
  plain.slopes = nullptr;
  const std::string message = "coupler: kernel 'plain' has no slopes, which a shear dipole needs";
  EXPECT_EQ(complaint([&] { dipole_length(plain, {2, 1}); }), message);
  EXPECT_EQ(complaint([&] { tangential_shortfall(plain, {2, 1}, 0.1); }), message);
  EXPECT_EQ(complaint([&] { tangential_shortfall(plain, {2, 1}, 0); }), "");
}

}  // namespace
}  // namespace tanktread::coupler
