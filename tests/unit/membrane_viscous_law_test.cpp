// The viscous law of an element: its parts, and its order in time.
#include "membrane/viscous_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test {
namespace {

ViscousParameters stiff(double shear_viscosity, double dilatational_viscosity) {
  ViscousParameters parameters;
  parameters.scheme = "int1";  // goes to the dashpot's stress exactly, however stiff the spring
  parameters.shear_viscosity = shear_viscosity;
  parameters.dilatational_viscosity = dilatational_viscosity;
  parameters.shear_spring = 1e4;
  parameters.dilatational_spring = 1e4;
  return parameters;
}

SymmetricTensor green_strain(const Eigen::Matrix2d& gradient) {
  return 0.5 * (SymmetricTensor::of(gradient.transpose() * gradient) - unit_tensor);
}

TEST(ViscousLaw, IsTheSurfaceFluidOfBoussinesqAndScriven) {
  // At rest shape, a small increment D dt: tau_v = mu_s (2 D - tr D I) + mu_d tr D I (Eq. 2.9). With dt = 1
  // and an increment of 1e-6 the mean U differs from I by 1e-6 at most, so does the stress, relatively.
  const double mu_s = 3.0, mu_d = 5.0;
  Eigen::Matrix2d rate;
  rate << 2e-6, 0.7e-6, 0.7e-6, -0.5e-6;
  ViscousState state{};
  ViscousLaw(stiff(mu_s, mu_d)).advance({}, SymmetricTensor::of(rate), state);
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d expected =
      mu_s * (2.0 * rate - rate.trace() * identity) + mu_d * rate.trace() * identity;
  EXPECT_LT((ViscousLaw::stress(state).matrix() - expected).norm(), 4e-6 * expected.norm());
}

TEST(ViscousLaw, PartsAreIndependent) {
  const SymmetricTensor shear = {1e-3, 2e-3, -1e-3}, dilatation = {1e-3, 0, 1e-3};
  ViscousParameters parameters = stiff(1, 0);
  parameters.measure = StressMeasure::rate_of_strain;  // linear: the parts do not mix at finite strain either
  ViscousState state{};
  ViscousLaw(parameters).advance({}, dilatation, state);
  EXPECT_EQ(ViscousLaw::stress(state).matrix().norm(), 0.0);
  parameters.shear_viscosity = 0;
  parameters.dilatational_viscosity = 1;
  ViscousLaw(parameters).advance({}, shear, state);
  EXPECT_EQ(ViscousLaw::stress(state).matrix().norm(), 0.0);
}

/// A finite stretch and shear in time, smooth, of period 1 in s.
Eigen::Matrix2d motion(double s) {
  const double phase = 2.0 * std::numbers::pi * s;
  Eigen::Matrix2d gradient;
  gradient << 1.0 + 0.3 * std::sin(phase), 0.2 * std::sin(2 * phase), 0.1 * std::cos(phase) - 0.1,
      1.0 - 0.2 * std::sin(phase);
  return gradient;
}

/// Stress after one and a quarter periods in n steps a period: mu and k' are set so that the physical
/// relaxation time is the same for every n (an interval is one step here).
Eigen::Matrix2d stress_after(const ViscousForm& form, int n) {
  ViscousParameters parameters;
  parameters.scheme = form.scheme;
  parameters.measure = form.measure;
  parameters.shear_viscosity = 1.0 * n;
  parameters.dilatational_viscosity = 0.5 * n;
  parameters.shear_spring = 20.0;
  parameters.dilatational_spring = 20.0;
  const ViscousLaw law(parameters);
  ViscousState state{};
  SymmetricTensor strain = green_strain(motion(0));
  for (int k = 1; k <= n * 5 / 4; ++k) {
    const SymmetricTensor next = green_strain(motion(static_cast<double>(k) / n));
    law.advance(strain, next, state);
    strain = next;
  }
  return ViscousLaw::stress(state).matrix();
}

class ViscousSchemes : public ::testing::TestWithParam<ViscousForm> {};
INSTANTIATE_TEST_SUITE_P(All, ViscousSchemes, ::testing::ValuesIn(viscous_forms()),
                         [](const auto& tested) { return test_name(tested.param); });

// The differences that it finds are the table of docs/viscous-membranes.md: --gtest_output=xml prints them.
TEST_P(ViscousSchemes, AreOfSecondOrderAtFiniteStrain) {
  const auto a = stress_after(GetParam(), 400), b = stress_after(GetParam(), 800),
             c = stress_after(GetParam(), 1600);
  const double order = std::log2((a - b).norm() / (b - c).norm());
  RecordProperty("stress", testing::PrintToString(c.norm()));
  RecordProperty("differences",
                 testing::PrintToString((a - b).norm()) + " " + testing::PrintToString((b - c).norm()));
  RecordProperty("order", testing::PrintToString(order));
  // The next even order adds (period/400)^2 times a few powers of 2 pi to the ratio, below 1 %: 0.01/ln 2.
  EXPECT_NEAR(order, 2.0, 0.015);
}

TEST(ViscousLaw, AnEvenGrowthGivesTheSameStressAtAnySize) {
  // Growing evenly by the factor g a step: D dt = ln g I to second order, whatever the size reached; the
  // increment of E is the square of the size times it.
  const double g = 1.001;
  ViscousState at_rest{}, inflated{};
  const ViscousLaw law(stiff(0, 1));
  const auto strain = [](double stretch) { return 0.5 * (stretch * stretch - 1) * unit_tensor; };
  law.advance(strain(1), strain(g), at_rest);
  law.advance(strain(2), strain(2 * g), inflated);
  // 2 mu_d tanh(ln g): short of 2 ln g by 2 (ln g)^3/3 = 6.7e-10.
  EXPECT_NEAR(at_rest[2], 2 * std::log(g), 7e-10);
  // Rounding: stretch^2 of 4 rounds by 2 eps, less 1 by one more, so E by 1.5 eps; U^-1 on both sides makes a
  // quarter of it and 2 mu_d the double: 0.75 eps. At rest E rounds by 0.25 eps: 0.5 eps. What is relative to
  // the stress of 0.002 does not count.
  EXPECT_NEAR(inflated[2], at_rest[2], 2 * epsilon);
}

TEST(ViscousLaw, RefusesBadParameters) {
  auto parameters = stiff(1, 1);
  parameters.interval = 0;
  EXPECT_THROW(ViscousLaw{parameters}, std::invalid_argument);
  parameters = stiff(-1, 1);
  EXPECT_THROW(ViscousLaw{parameters}, std::invalid_argument);
  parameters = stiff(1, 1);
  parameters.dilatational_spring = 0;
  EXPECT_THROW(ViscousLaw{parameters}, std::invalid_argument);
  parameters.dilatational_viscosity = 0;  // no dashpot, no spring needed
  EXPECT_NO_THROW(ViscousLaw{parameters});
  parameters.scheme = "euler";
  EXPECT_THROW(ViscousLaw{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::membrane::test
