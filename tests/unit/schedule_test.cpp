// Shear times as steps, up to the ends of what numbers can be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "driver/units/schedule.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

FlowParameters with_steps(double steps_per_shear_time) {
  FlowParameters parameters;
  parameters.steps_per_shear_time = steps_per_shear_time;
  return parameters;
}

std::string refusal_of(double shear_times, double steps_per_shear_time) {
  try {
    steps_of(shear_times, with_steps(steps_per_shear_time), "the key");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Schedule, StepsAreTheNearestUpToTheBound) {
  EXPECT_EQ(steps_of(2.0, with_steps(100.3), ""), 201);
  EXPECT_EQ(steps_of(99999999.99, with_steps(100), ""), most_steps);
  EXPECT_EQ(steps_of(0, with_steps(100), ""), 0);
}

TEST(Schedule, StepsBeyondTheBoundAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<double, double>> all = {
      {1e8, 100}, {1e18, 600}, {1e308, 1e300}, {1, infinity}, {-1e18, 600}, {0, infinity}};  // 0 * inf is NaN
  for (const auto& [shear_times, steps] : all) {
    EXPECT_THAT(refusal_of(shear_times, steps),
                AllOf(HasSubstr("the key = "), HasSubstr("over the 9999999999")))
        << shear_times << " " << steps;
  }
  // What the message advises is taken.
  EXPECT_THAT(refusal_of(1e18, 600), HasSubstr("at most 1.66667e+07"));
  EXPECT_EQ(refusal_of(1.66666e7, 600), "");
}

TEST(Schedule, AnIntervalBeyondTheEndIsDueAtTheStartOnly) {
  for (const double interval : {1e8, 1e18, 1e300, std::numeric_limits<double>::infinity()}) {
    const auto schedule = schedule_of(interval, with_steps(100));
    EXPECT_TRUE(schedule.due(0));
    for (const std::int64_t step : {std::int64_t{1}, std::int64_t{600}, most_steps})
      EXPECT_FALSE(schedule.due(step));
  }
  EXPECT_EQ(schedule_of(0.05, with_steps(100)).interval, 5);
  EXPECT_EQ(schedule_of(1e-300, with_steps(100)).interval, 1);
  EXPECT_FALSE(schedule_of(0, with_steps(100)).due(0));
}

TEST(Schedule, TheEndOfARunNamesFileAndKey) {
  const auto the_case = parse(least_case, {"run.shear_time=1e18"});
  try {
    last_step_of(the_case, flow_parameters(the_case));
    ADD_FAILURE() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("case.toml: run.shear_time = 1e+18 shear times"));
  }
}

}  // namespace
