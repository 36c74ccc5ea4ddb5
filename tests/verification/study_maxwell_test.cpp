// The study of the Maxwell element: exact stress, published errors, order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driver/study/study_maxwell.hpp"

namespace tanktread::driver {
namespace {

/// Sect. 2.3.1 of the thesis.
MaxwellStudy published(double time_step) {
  return {.viscosity = 1, .stiffness = 0.5, .period = 20, .time_step = time_step};
}

TEST(MaxwellStudy, ExactStressObeysTheElement) {
  const MaxwellStudy study = published(1.0);
  EXPECT_NEAR(exact_stress(study, 0.0), 0.0, 1e-16);
  // sigma' + sigma/tau = k' eps', and mu eps' is the stress of the dashpot. The central difference is off by
  // h^2/6 times the third derivative, of about (2 pi/T0)^3 + 1/tau^3 = 0.16 at most: 2.7e-10; its rounding by
  // 1e-16/h = 1e-12.
  const double h = 1e-4, tau = study.relaxation_time();
  for (const double time : {0.3, 4.0, 17.0}) {
    const double rate = (exact_stress(study, time + h) - exact_stress(study, time - h)) / (2 * h);
    EXPECT_NEAR(rate + exact_stress(study, time) / tau, dashpot_stress(study, time) / tau, 1e-9);
  }
}

TEST(MaxwellStudy, GivesThePublishedErrors) {
  // Three digits are printed: half a unit of the last.
  EXPECT_NEAR(maxwell_errors(published(4)).scheme, 0.126, 0.0005);
  EXPECT_NEAR(maxwell_errors(published(2)).scheme, 0.0280, 0.00005);
  EXPECT_NEAR(maxwell_errors(published(1)).scheme, 0.00670, 0.000005);
}

TEST(MaxwellStudy, EverySchemeIsOfSecondOrder) {
  for (const char* scheme : {"fd", "int1", "int2"}) {
    MaxwellStudy coarse = published(0.25), fine = published(0.125);
    coarse.scheme = fine.scheme = scheme;
    // The next order adds (dt/tau)^2 to the ratio of the errors, about 1 %.
    const double order = std::log2(maxwell_errors(coarse).scheme / maxwell_errors(fine).scheme);
    EXPECT_GT(order, 1.95) << scheme;
    EXPECT_LT(order, 2.05) << scheme;
  }
}

TEST(MaxwellStudy, NoUnitMatters) {
  // Another unit of time and of force, and another amplitude; time steps that are no whole numbers.
  const MaxwellStudy one = published(0.8);
  const MaxwellStudy other = {.viscosity = one.viscosity * 3 * 0.7,
                              .stiffness = one.stiffness * 3,
                              .strain_amplitude = 0.01,
                              .period = one.period * 0.7,
                              .time_step = one.time_step * 0.7};
  const MaxwellErrors a = maxwell_errors(one), b = maxwell_errors(other);
  // Rounding: 25 steps of sums of numbers of order 1, over errors of 1e-3 and more.
  EXPECT_NEAR(a.artificial, b.artificial, 1e-12);
  EXPECT_NEAR(a.scheme, b.scheme, 1e-12);
  EXPECT_NEAR(a.overall, b.overall, 1e-12);
}

TEST(MaxwellStudy, AStiffSpringLeavesTheDashpot) {
  // L0 = omega tau for a short relaxation time, but for the transient and the next order, (omega tau)^2.
  const MaxwellStudy study = {.viscosity = 1, .stiffness = 100, .period = 20, .time_step = 0.01};
  const double expected = 2.0 * M_PI / study.period * study.relaxation_time();
  EXPECT_NEAR(maxwell_errors(study).artificial, expected, expected * 0.01);
  EXPECT_NEAR(maxwell_errors(study).overall, expected, expected * 0.01);
}

TEST(MaxwellStudy, TakesStepsToTheEndOfThePeriod) {
  EXPECT_EQ(computed_stress(published(4)).size(), 5U);
  EXPECT_EQ(computed_stress(published(20.0 / 3)).size(), 3U);  // a rounding off
  EXPECT_EQ(computed_stress(published(3)).size(), 6U);
}

TEST(MaxwellStudy, RefusesWhatIsOutOfRange) {
  const auto refusal = [](MaxwellStudy study) -> std::string {
    try {
      computed_stress(study);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(refusal({.viscosity = -1}), ::testing::HasSubstr("viscosity is -1, must be positive"));
  EXPECT_THAT(refusal({.period = 4, .time_step = 3}), ::testing::HasSubstr("more than half of the period 4"));
  EXPECT_THAT(refusal({.scheme = "rk4"}), ::testing::HasSubstr("fd, int1, int2"));
}

}  // namespace
}  // namespace tanktread::driver
