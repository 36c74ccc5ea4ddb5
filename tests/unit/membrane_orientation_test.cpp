// How long a surface is, and which way it points: shapes that are known exactly.
#include "membrane/orientation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "membrane/node_areas.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::orientation_test {
namespace {

/// Places up to 50, sums of some hundred terms.
constexpr double rounding = 1e-12;

const Eigen::Vector3d place(30.2, 17.7, 41.3);

/// An ellipsoid of these semi-axes about the origin: an icosphere has nodes on all three axes.
Eigen::Matrix3Xd ellipsoid(const TriangleMesh& sphere, const Eigen::Vector3d& semi_axes) {
  return semi_axes.asDiagonal() * sphere.points;
}

TEST(Orientation, ExtentsOfAnEllipsoidAreItsAxes) {
  const auto sphere = icosphere(3, 1);
  const Eigen::Matrix3Xd points = ellipsoid(sphere, {4, 2, 3});
  const Eigen::Matrix3d turn = rotation({1, 2, -1}, 0.9);
  for (int axis = 0; axis < 3; ++axis) {
    const double lengths[] = {8, 4, 6}, across[] = {6, 8, 8};
    const Eigen::Vector3d along = turn.col(axis);
    const Eigen::Matrix3Xd turned = (turn * points).colwise() + place;
    EXPECT_NEAR(extent_along(turned, along), lengths[axis], rounding);
    EXPECT_NEAR(extent_along(turned, -along), lengths[axis], rounding);
    EXPECT_NEAR(largest_extent_across(turned, along), across[axis], rounding);
  }
}

TEST(Orientation, TheExtentAcrossIsTheLargestOfAll) {
  const auto sphere = icosphere(2, 5, place);
  const Eigen::Matrix3Xd points = smoothly_deformed(sphere.points);
  const Eigen::Vector3d along = Eigen::Vector3d(0.2, -0.5, 0.7).normalized();
  const double largest = largest_extent_across(points, along);
  const Eigen::Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  double found = 0;
  for (int k = 0; k < 3600; ++k) {
    const double angle = k * std::numbers::pi / 3600;
    const double extent = extent_along(points, std::cos(angle) * u + std::sin(angle) * v);
    EXPECT_LE(extent, largest + rounding);
    found = std::max(found, extent);
  }
  // The nearest of these directions is off by 1/7200 of pi at most: its extent by the square of that.
  EXPECT_NEAR(found, largest, 1e-6 * largest);
}

TEST(Orientation, ADirectionIsCarriedByAnyLinearMotion) {
  const auto mesh = icosphere(2, 5, place);
  const Eigen::Matrix3Xd start = smoothly_deformed(mesh.points);
  const auto areas = node_areas(start, mesh.triangles);
  const Eigen::Vector3d direction = Eigen::Vector3d(0.2, -0.5, 0.7).normalized(), shift(3, -70, 11);
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 2) = 0.8;
  // A membrane that treads round an ellipsoid: the motion of a sphere, stretched.
  const Eigen::Matrix3d stretch = Eigen::Vector3d(4, 2, 3).asDiagonal();
  const Eigen::Matrix3d tread = stretch * rotation({0, 1, 0}, 1.1) * stretch.inverse();
  for (const Eigen::Matrix3d& map :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), rotation({1, 1, 3}, 2.8), shear, tread}) {
    const Eigen::Matrix3Xd points = (map * start).colwise() + shift;
    EXPECT_LT((carried_direction(start, areas, direction, points) - map * direction).norm(), 10 * rounding);
  }
}

TEST(Orientation, ACarriedDirectionNeedsTheSameNodes) {
  const auto one = icosphere(1, 1), two = icosphere(2, 1);
  const auto areas = node_areas(one.points, one.triangles);
  EXPECT_EQ(refusal_message([&] { carried_direction(one.points, areas, place, two.points); }),
            "carried direction: start, areas and points must be of the same nodes");
}

TEST(Orientation, TheShortestAxisIsThatOfTheEllipsoid) {
  const auto sphere = icosphere(3, 1);
  const Eigen::Matrix3d turn = rotation({1, 2, -1}, 0.9);
  const Eigen::Matrix3Xd points = (turn * ellipsoid(sphere, {4, 2, 3})).colwise() + place;
  const auto axis = shortest_axis(volume_moments(points, sphere.triangles));
  EXPECT_NEAR(std::abs(axis.dot(turn.col(1))), 1, rounding);
  EXPECT_EQ(shortest_axis(volume_moments(sphere.points, sphere.triangles)), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace tanktread::membrane::test::orientation_test
