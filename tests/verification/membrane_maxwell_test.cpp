// The Maxwell element alone, against its exact stress under a strain 1 - cos(2 pi t/T0) (thesis,
// Eqs. 2.28-2.29).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "membrane/maxwell.hpp"

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

TEST(Maxwell, FiniteDifferencesGiveThePublishedErrors) {
  // Thesis, Sect. 2.3.1, three digits printed: half a unit of the last is 0.4 % at most.
  const auto& scheme = maxwell_scheme("fd");
  EXPECT_NEAR(relative_error(scheme, 5), 0.126, 0.0005);
  EXPECT_NEAR(relative_error(scheme, 10), 0.0280, 0.00005);
  EXPECT_NEAR(relative_error(scheme, 20), 0.00670, 0.000005);
}

class MaxwellSchemes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, MaxwellSchemes, ::testing::Values("fd", "int1", "int2"));

TEST_P(MaxwellSchemes, AreOfSecondOrder) {
  const auto& scheme = maxwell_scheme(GetParam());
  // With 80 and 160 steps a period dt/tau is 1/8 and 1/16: the next order adds (dt/tau)^2 to the ratio, about
  // 1 %.
  const double order = std::log2(relative_error(scheme, 80) / relative_error(scheme, 160));
  EXPECT_GT(order, 1.95);
  EXPECT_LT(order, 2.05);
}

TEST_P(MaxwellSchemes, RelaxWithTauAndSpringAtOnce) {
  const double tau = viscosity / stiffness, dt = 1e-3 * tau;
  const auto step = maxwell_scheme(GetParam()).step(viscosity, stiffness, dt);
  // A sudden strain meets the spring alone: k', less the relaxation within the step, dt/(2 tau) = 5e-4 of it.
  EXPECT_NEAR(step.advance(0.0, 1.0), stiffness, 6e-4 * stiffness);
  // At rest the stress falls by exp(-dt/tau); fd does so to (dt/tau)^3/12.
  EXPECT_NEAR(step.advance(1.0, 0.0), std::exp(-1e-3), 1e-10);
}

TEST_P(MaxwellSchemes, BecomeTheDashpotForAStiffSpring) {
  // Under a steady strain rate the stress goes to mu times the rate, whatever tau.
  const double rate = 0.3, dt = 0.1;
  const auto step = maxwell_scheme(GetParam()).step(viscosity, 50.0, dt);
  double stress = 0;
  for (int k = 0; k < 400; ++k) stress = step.advance(stress, rate * dt);
  // The fixed point is gain rate dt/(1 - decay): exact for fd and int1; int2 is off by (dt/tau)/2
  // coth((dt/tau)/2).
  const double x = dt * 50.0 / viscosity;
  const double expected = std::string(GetParam()) == "int2" ? 0.5 * x / std::tanh(0.5 * x) : 1.0;
  EXPECT_NEAR(stress, expected * viscosity * rate, 1e-12);
}

TEST(Maxwell, UnknownSchemeListsTheKnown) {
  try {
    maxwell_scheme("rk4");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("fd, int1, int2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tanktread::membrane
