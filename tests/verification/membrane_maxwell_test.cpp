// The Maxwell element alone: every scheme of the table against the exact stress under a strain
// 1 - cos(2 pi t/T0) (thesis, Eqs. 2.28-2.29) and against its limits. The errors that the thesis prints are
// those of the study (study_maxwell_test.cpp).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane {
namespace {

constexpr double viscosity = 1.0, stiffness = 0.5, period = 20.0;

double exact_stress(double t) {
  const double tau = viscosity / stiffness, omega = 2.0 * std::numbers::pi / period;
  return viscosity * omega *
         (std::sin(omega * t) - omega * tau * std::cos(omega * t) + omega * tau * std::exp(-t / tau)) /
         (omega * omega * tau * tau + 1.0);
}

/// Relative L2 error over the first period, sums over all steps (Eq. 3.34).
double relative_error(const MaxwellScheme& scheme, int n_steps) {
  const double dt = period / n_steps;
  const auto step = scheme.step(viscosity, stiffness, dt);
  double stress = 0, strain = 0, error = 0, norm = 0;
  for (int k = 1; k <= n_steps; ++k) {
    const double next = 1.0 - std::cos(2.0 * std::numbers::pi * k / n_steps);
    stress = step.advance(stress, next - strain);
    strain = next;
    const double exact = exact_stress(k * dt);
    error += (stress - exact) * (stress - exact);
    norm += exact * exact;
  }
  return std::sqrt(error / norm);
}

class MaxwellSchemes : public ::testing::TestWithParam<MaxwellScheme> {};
INSTANTIATE_TEST_SUITE_P(All, MaxwellSchemes, ::testing::ValuesIn(maxwell_schemes()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(MaxwellSchemes, AreOfSecondOrder) {
  // With 80 and 160 steps a period dt/tau is 1/8 and 1/16: the next order adds (dt/tau)^2 to the ratio, about
  // 1 %.
  const double order = std::log2(relative_error(GetParam(), 80) / relative_error(GetParam(), 160));
  EXPECT_GT(order, 1.95);
  EXPECT_LT(order, 2.05);
}

TEST_P(MaxwellSchemes, RelaxWithTauAndSpringAtOnce) {
  const double tau = viscosity / stiffness, dt = 1e-3 * tau;
  const auto step = GetParam().step(viscosity, stiffness, dt);
  // A sudden strain meets the spring alone: k', less the relaxation within the step, dt/(2 tau) = 5e-4 of it.
  EXPECT_NEAR(step.advance(0.0, 1.0), stiffness, 6e-4 * stiffness);
  // At rest the stress falls by exp(-dt/tau); fd does so to (dt/tau)^3/12.
  EXPECT_NEAR(step.advance(1.0, 0.0), std::exp(-1e-3), 1e-10);
}

/// Stress after many steps under a steady strain rate, over that of the dashpot. @param x dt/tau
double steady_stress(const MaxwellScheme& scheme, double x) {
  const double rate = 0.3, dt = 0.1;
  const auto step = scheme.step(viscosity, x * viscosity / dt, dt);
  double stress = 0;
  // Until exp(-400 x) is below the rounding, for x of 0.1 and above.
  for (int k = 0; k < 400; ++k) stress = step.advance(stress, rate * dt);
  return stress / (viscosity * rate);
}

TEST_P(MaxwellSchemes, GoToTheDashpotUnderASteadyRate) {
  // Whatever tau, as the spring stretches no more. A scheme of second order is off by (dt/tau)^2 times a
  // number below 1 (1/12 for int2); one of first order would be by dt/tau/2.
  EXPECT_NEAR(steady_stress(GetParam(), 0.1), 1.0, 0.1 * 0.1);
}

TEST(Maxwell, AStiffSpringLeavesTheDashpotButNotByTheTrapezoidalRule) {
  // The fixed point is gain rate dt/(1 - decay), by the factors of Table 3.2: 1 for fd and int1, x/2
  // coth(x/2) for int2. Some five roundings a step, each forgotten at the rate at which the stress decays (by
  // 3/7 a step at the slowest, fd): 5/(1 - 3/7) eps = 2e-15.
  const double x = 5, bound = 5e-15;
  EXPECT_NEAR(steady_stress(maxwell_scheme("fd"), x), 1.0, bound);
  EXPECT_NEAR(steady_stress(maxwell_scheme("int1"), x), 1.0, bound);
  EXPECT_NEAR(steady_stress(maxwell_scheme("int2"), x), 0.5 * x / std::tanh(0.5 * x), bound);
}

TEST(Maxwell, UnknownSchemeListsTheKnown) {
  std::string known;
  for (const auto& scheme : maxwell_schemes()) known += (known.empty() ? "" : ", ") + scheme.name;
  try {
    maxwell_scheme("rk4");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), "unknown Maxwell scheme 'rk4'; known are " + known);
  }
}

}  // namespace
}  // namespace tanktread::membrane
