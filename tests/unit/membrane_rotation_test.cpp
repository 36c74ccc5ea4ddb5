// How shapes are turned: by a direction, and by Euler angles.
#include "membrane/rotation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::rotation_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A matrix of numbers up to 1, each from up to three products: some epsilons.
constexpr double rounding = 8 * epsilon;

void expect_rotation(const Matrix3d& r) {
  EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff(), rounding);
  EXPECT_NEAR(r.determinant(), 1, rounding);
}

TEST(Rotation, OfZToADirectionIsTheShortestTurn) {
  std::vector<Vector3d> directions = {{1, 0, 0},
                                      {0, -2, 0},
                                      {0, 0, 3},
                                      {1, 2, 3},
                                      {-1, 2, -3},
                                      {1e-9, 0, -1},
                                      {1e-200, 1e-200, -1e-200},
                                      {0, 0, -4},
                                      {1e-9, -1e-9, 1}};
  for (const auto& direction : directions) {
    const Matrix3d r = rotation_of_z_to(direction);
    expect_rotation(r);
    const Vector3d to = direction.stableNormalized();
    EXPECT_LT((r * Vector3d::UnitZ() - to).norm(), rounding) << direction.transpose();
    // Its angle, of trace 1 + 2 cos, is that between z and the direction, and no more.
    EXPECT_NEAR(r.trace(), 1 + 2 * to[2], rounding) << direction.transpose();
  }
}

TEST(Rotation, OfZToAnAxisIsExact) {
  EXPECT_EQ(rotation_of_z_to({0, 0, 7}), Matrix3d::Identity());
  EXPECT_EQ(rotation_of_z_to({0, 0, -7}), Matrix3d(Vector3d(1, -1, -1).asDiagonal()));
  EXPECT_EQ(rotation_of_z_to({5, 0, 0}) * Vector3d::UnitZ(), Vector3d::UnitX());
  EXPECT_EQ(rotation_of_z_to({5, 0, 0}) * Vector3d::UnitY(), Vector3d::UnitY());
}

TEST(Rotation, ByEulerAnglesIsAboutZTheNewXAndTheNewZ) {
  const std::array<double, 3> degrees = {25, -140, 300};
  const auto radians = [&](int k) { return degrees[k] * std::numbers::pi / 180; };
  // Each turn about an axis as the turns before have left it.
  const Matrix3d first = Eigen::AngleAxisd(radians(0), Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d new_x = first * Vector3d::UnitX();
  const Matrix3d second = Eigen::AngleAxisd(radians(1), new_x).toRotationMatrix() * first;
  const Vector3d new_z = second * Vector3d::UnitZ();
  const Matrix3d third = Eigen::AngleAxisd(radians(2), new_z).toRotationMatrix() * second;
  const Matrix3d r = rotation_by_euler_angles(degrees);
  expect_rotation(r);
  EXPECT_LT((r - third).cwiseAbs().maxCoeff(), 2 * rounding);
  const double a = radians(0), b = radians(1);
  const Vector3d axis(std::sin(a) * std::sin(b), -std::cos(a) * std::sin(b), std::cos(b));
  EXPECT_LT((r * Vector3d::UnitZ() - axis).norm(), rounding);
}

TEST(Rotation, QuartersOfATurnAreExact) {
  EXPECT_EQ(rotation_by_euler_angles({0, 0, 0}), Matrix3d::Identity());
  EXPECT_EQ(rotation_by_euler_angles({360, -720, 1080}), Matrix3d::Identity());
  EXPECT_EQ(rotation_by_euler_angles({0, 90, 0}) * Vector3d::UnitZ(), -Vector3d::UnitY());
  EXPECT_EQ(rotation_by_euler_angles({90, 90, 0}) * Vector3d::UnitZ(), Vector3d::UnitX());
  EXPECT_EQ(rotation_by_euler_angles({-90, 180, 270}) * Vector3d::UnitZ(), -Vector3d::UnitZ());
}

TEST(Rotation, RefusesWhatHasNoDirection) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(rotation_of_z_to({0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(rotation_of_z_to({nan, 0, 1}), std::invalid_argument);
  EXPECT_THROW(rotation_of_z_to({0, infinite, 1}), std::invalid_argument);
  EXPECT_THROW(rotation_by_euler_angles({0, nan, 0}), std::invalid_argument);
  EXPECT_THROW(rotation_by_euler_angles({infinite, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::membrane::test::rotation_test
