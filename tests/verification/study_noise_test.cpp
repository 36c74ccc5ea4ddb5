// The study of the noise of a strain rate: the positions that its source quotes, and what kernel and interval
// do.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/study/study_noise.hpp"

namespace tanktread::driver {
namespace {

TEST(NoiseStudy, PositionsAreThoseQuoted) {
  const auto positions = streamline_positions({});
  ASSERT_EQ(positions.cols(), 500);
  // Appendix A of the thesis, four digits, positions counted from 1.
  EXPECT_NEAR(positions(0, 0), 0.623, 0.0005);
  EXPECT_NEAR(positions(1, 19), 0.8840, 0.00005);
  EXPECT_NEAR(positions(1, 20), 0.8793, 0.00005);
  EXPECT_NEAR(positions(0, 324), 0.5598, 0.00005);
  EXPECT_NEAR(positions(0, 325), 0.5610, 0.00005);
}

TEST(NoiseStudy, InterpolatesWhatTheKernelCan) {
  NoiseStudy study;
  const Eigen::Vector2d position(0.4321, 0.2345), exact = corner_flow(position);
  // cosine4: its first moment, 0.021 grid steps at most, times a gradient of 6 |x| per axis, 3 here: 6.3e-4
  // each.
  EXPECT_LT((interpolated_velocity(study, position) - exact).cwiseAbs().maxCoeff(), 1.3e-3);
  EXPECT_GT((interpolated_velocity(study, position) - exact).norm(), 1e-5);
  // peskin4: only the second moment is left, the same along x and y but for what varies with the place; of
  // that, with the second derivatives 6, less than 3 (0.01)^2.
  study.kernel = "peskin4";
  EXPECT_LT((interpolated_velocity(study, position) - exact).norm(), 3e-4);
  study.velocity_error = 0.5;
  EXPECT_NEAR(interpolated_velocity(study, position).norm() / exact.norm(), 1.5, 0.001);
}

TEST(NoiseStudy, NoiseOfOneStepIsThePublished) {
  // 0.0863 is printed; ours is 2.4 % below it (cases/strain-rate-noise).
  EXPECT_NEAR(strain_rate_error({}, 1), 0.0863, 0.05 * 0.0863);
}

TEST(NoiseStudy, NoiseFallsWithTheInterval) {
  double last = strain_rate_error({}, 1);
  for (const int interval : {5, 10, 20, 40}) {
    const double error = strain_rate_error({}, interval);
    EXPECT_LT(error, last);
    last = error;
  }
  // A bounded error of the velocity over a displacement: like 1/N at most.
  EXPECT_LT(last, strain_rate_error({}, 1) / 20);
}

TEST(NoiseStudy, ASmoothErrorOfTheVelocityStays) {
  const double noise = strain_rate_error({}, 40);
  EXPECT_NEAR(strain_rate_error({.velocity_error = -0.03}, 40), 0.03, noise);
}

TEST(NoiseStudy, TheFirstMomentMakesTheNoise) {
  // Without a first moment the error of the velocity is of second order in the grid step, 0.01, not of first.
  EXPECT_LT(strain_rate_error({.kernel = "peskin4"}, 1), strain_rate_error({}, 1) / 20);
}

TEST(NoiseStudy, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(strain_rate_error({}, 0), std::invalid_argument);
  EXPECT_THROW(strain_rate_error({}, 500), std::invalid_argument);
  EXPECT_THROW(strain_rate_error({.kernel = "none"}, 1), std::invalid_argument);
  EXPECT_THROW(streamline_positions({.start_height = -0.5}), std::invalid_argument);
  EXPECT_THROW(streamline_positions({.time_step = 10}), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::driver
