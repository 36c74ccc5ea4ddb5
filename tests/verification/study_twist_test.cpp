// The twisting sphere: its exact motion by differences, and the errors of elements on coarse meshes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "driver/study/study_twist.hpp"
#include "driver/study/twisting_sphere.hpp"

namespace tanktread::driver {
namespace {

const TwistingSphere sphere{{3, -2, 5}, 2.0, 0.3, 50.0};

TEST(TwistingSphere, VelocityIsTheRateOfItsPositions) {
  const Eigen::Vector3d start = sphere.centre + 2.0 * Eigen::Vector3d(0.5, 0.3, 0.6).normalized();
  // Central difference: off by h^2/6 A0 R omega^3 = 2e-4 h^2, and by rounding, 1e-15/h.
  const double time = 12.0, h = 1e-3;
  const Eigen::Vector3d rate = (sphere.twisted(start, time + h) - sphere.twisted(start, time - h)) / (2 * h);
  EXPECT_LT((rate - sphere.velocity(sphere.twisted(start, time), time)).norm(), 3e-10);
  EXPECT_NEAR((sphere.twisted(start, time) - sphere.centre).norm(), 2.0, 1e-15);
  EXPECT_GT(rate.norm(), 0.01);
}

TEST(TwistingSphere, ShearRateIsThatOfItsVelocity) {
  const double time = 12.0, h = 1e-5;
  const Eigen::Vector3d position = sphere.centre + 2.0 * Eigen::Vector3d(-0.5, 0.3, 0.4).normalized();
  Eigen::Matrix3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    gradient.col(axis) =
        (sphere.velocity(position + step, time) - sphere.velocity(position - step, time)) / (2 * h);
  }
  const auto frame = sphere.frame(position);
  const Eigen::Matrix3d rate = 0.5 * (gradient + gradient.transpose());
  // Central difference of velocities of 0.1: rounding of 1e-17/h = 1e-12; truncation h^2 = 1e-10 times 0.01.
  EXPECT_NEAR(frame.e_theta.dot(rate * frame.e_phi), sphere.shear_rate(frame.polar_angle, time), 1e-11);
  EXPECT_NEAR(frame.e_theta.dot(rate * frame.e_theta), 0.0, 1e-11);
  EXPECT_NEAR(frame.e_phi.dot(rate * frame.e_phi), 0.0, 1e-11);
  EXPECT_NEAR(frame.e_theta.cross(frame.e_phi).dot(position - sphere.centre), 2.0, 1e-14);
}

TEST(TwistingSphere, ShearStressObeysTheMaxwellElement) {
  // sigma' + sigma/tau = (mu/tau) rate; central difference as above, third derivative below 0.01.
  const double theta = 0.7, viscosity = 3, tau = 4, time = 9, h = 1e-4;
  const auto stress = [&](double t) { return sphere.shear_stress(theta, t, viscosity, tau); };
  EXPECT_NEAR((stress(time + h) - stress(time - h)) / (2 * h) + stress(time) / tau,
              viscosity / tau * sphere.shear_rate(theta, time), 1e-10);
  EXPECT_NEAR(stress(0.0), 0.0, 1e-16);
}

/// A quarter of a short period; the relaxation time is 10 steps.
TwistStudy short_study(TwistApproach approach, int level) {
  TwistStudy study;
  study.approach = approach;
  study.level = level;
  study.schemes = {"fd"};
  study.period = 200;
  study.stiffness = 1.0;
  study.times = {0.25};
  return study;
}

TwistErrors only(const TwistStudy& study) {
  const auto errors = twist_errors(study);
  EXPECT_EQ(errors.size(), 1U);
  return errors.at(0);
}

TEST(TwistStudy, ElementsAreOfFirstOrderInTheirEdge) {
  TwistStudy study = short_study(TwistApproach::surface, 3);
  // The frame turns by A0 omega/2 in half a step, which is 5e-4 of the shear: small beside the errors of the
  // mesh.
  study.period = 1000;
  const auto coarse = only(study);
  study.level = 4;
  const auto fine = only(study);
  // The gradient of a linear interpolant is off by an edge times the second derivative; the next order is the
  // edge, 0.15 of a radius on the coarse mesh.
  for (int component = 0; component < 3; ++component) {
    for (const double order : {std::log2(coarse.strain_rate[component] / fine.strain_rate[component]),
                               std::log2(coarse.stress[component] / fine.stress[component])}) {
      EXPECT_GT(order, 0.85) << component;
      EXPECT_LT(order, 1.15) << component;
    }
  }
  // Table 3.3 of the thesis, digits times 1e-2, with the fine mesh (period and viscosity hardly matter to
  // it).
  EXPECT_NEAR(fine.strain_rate[1], 0.0268, 0.15 * 0.0268);
  EXPECT_NEAR(fine.strain_rate[0], 0.0283, 0.5 * 0.0283);
}

TEST(TwistStudy, TurningTheMeshAboutTheAxisOfTheTwistChangesNothing) {
  TwistStudy study = short_study(TwistApproach::surface, 2);
  const auto straight = only(study);
  study.angle_deg = 40;
  const auto turned = only(study);
  study.axis = {1, 0, 0};
  const auto tilted = only(study);
  for (int component = 0; component < 3; ++component) {
    // Rounding of strains, 1e-16, over increments of 1e-3 a step, accumulated over a relaxation time.
    EXPECT_NEAR(turned.strain_rate[component], straight.strain_rate[component], 1e-10);
    EXPECT_NEAR(turned.stress[component], straight.stress[component], 1e-10);
  }
  EXPECT_GT(std::abs(tilted.strain_rate[1] - straight.strain_rate[1]), 1e-3);
}

TEST(TwistStudy, TheFlowAddsTheNoiseOfItsKernel) {
  TwistStudy study = short_study(TwistApproach::flow, 3);
  const auto exact = only(short_study(TwistApproach::surface, 3));
  const auto noisy = only(study);
  study.kernel = "peskin4";
  const auto quiet = only(study);
  for (int component = 0; component < 3; ++component) {
    // A kernel that interpolates linear fields exactly leaves errors of second order, (1/R)^2 = 0.0025 times
    // derivatives of order 1 to 6, and an Euler step's: 0.6 % of the way.
    EXPECT_NEAR(quiet.strain_rate[component], exact.strain_rate[component], 0.005);
    EXPECT_GT(noisy.strain_rate[component], quiet.strain_rate[component]);
  }
  EXPECT_GT(noisy.strain_rate[2], quiet.strain_rate[2] + 0.005);
}

TEST(TwistStudy, ReadingsComeInOrderOfTimeForEveryScheme) {
  TwistStudy study = short_study(TwistApproach::surface, 1);
  study.schemes = {"fd", "int1"};
  study.times = {0.5, 0.25};
  const auto errors = twist_errors(study);
  ASSERT_EQ(errors.size(), 4U);
  EXPECT_EQ(errors[0].time, 0.25);
  EXPECT_EQ(errors[1].scheme, "int1");
  EXPECT_EQ(errors[3].time, 0.5);
  EXPECT_EQ(errors[0].strain_rate, errors[1].strain_rate);
  EXPECT_NE(errors[0].stress, errors[1].stress);
}

TEST(TwistStudy, RefusesWhatIsOutOfRange) {
  TwistStudy study = short_study(TwistApproach::surface, 1);
  study.axis = {0, 0, 0};
  EXPECT_THROW(twist_errors(study), std::invalid_argument);
  study = short_study(TwistApproach::surface, 1);
  study.times = {0.0};
  EXPECT_THROW(twist_errors(study), std::invalid_argument);
  study = short_study(TwistApproach::flow, 1);
  study.kernel = "none";
  EXPECT_THROW(twist_errors(study), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::driver
