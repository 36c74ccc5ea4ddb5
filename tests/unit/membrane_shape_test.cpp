// Volume, moments, D and inclination of ellipsoids whose answer is known exactly.
#include "membrane/shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::shape_test {
namespace {

// The second moment of an icosphere of any level is a multiple of the identity, by the symmetry of the
// icosahedron. So that of its linear image has exactly the axes and the D of the ellipsoid; only lengths
// carry the factor by which the icosphere is smaller than the sphere. Rounding: some thousand terms of either
// sign add up, each by epsilon/2 of about the sum, so 1000 epsilon is generous and far from anything seen by
// eye.
constexpr double rounding = 1000 * epsilon;

/// Semi-axes `along` and `across` in the plane of the two axes, the first at `degrees` from `flow` to
/// `gradient`.
struct Inclined {
  int flow, gradient;
  double along, across, breadth, degrees;

  Eigen::Matrix3d map() const {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector3d f = Eigen::Vector3d::Unit(flow), g = Eigen::Vector3d::Unit(gradient);
    Eigen::Matrix3d axes;
    axes.col(0) = std::cos(angle) * f + std::sin(angle) * g;
    axes.col(1) = -std::sin(angle) * f + std::cos(angle) * g;
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes * Eigen::Vector3d(along, across, breadth).asDiagonal() * axes.transpose();
  }
};

TEST(Deformation, IsThatOfAnEllipsoidInEveryShearPlaneAndAtEveryInclination) {
  const auto sphere = icosphere(2, 1);
  for (int flow = 0; flow < 3; ++flow) {
    for (int gradient = 0; gradient < 3; ++gradient) {
      if (gradient == flow) continue;
      for (const double degrees : {-80.0, -45.0, -10.0, 0.0, 23.5, 45.0, 89.0}) {
        const Inclined ellipsoid{flow, gradient, 1.5, 0.7, 1.2, degrees};
        const auto shape =
            deformation(volume_moments(ellipsoid.map() * sphere.points, sphere.triangles), flow, gradient);
        EXPECT_NEAR(shape.deformation, 0.8 / 2.2, rounding);
        EXPECT_NEAR(shape.inclination_deg, degrees, 90 * rounding) << flow << gradient;
        EXPECT_NEAR(shape.length / shape.width, 1.5 / 0.7, 3 * rounding);
        EXPECT_NEAR(shape.length / shape.breadth, 1.5 / 1.2, 3 * rounding);
      }
    }
  }
}

// A box of edges 2, 4, 6 is exact: volume 48, second moment V edge^2/12 along each axis.
TEST(VolumeMoments, OfABoxAreExact) {
  const auto box = cube(1);
  const Eigen::Vector3d edges(2, 4, 6), corner(-1, 0.5, 3);
  const Eigen::Matrix3Xd points = (edges.asDiagonal() * box.mesh.points).colwise() + corner;
  const auto moments = volume_moments(points, box.mesh.triangles);
  EXPECT_NEAR(moments.volume, 48, 48 * rounding);
  EXPECT_LT((moments.centroid - corner - edges / 2).norm(), 10 * rounding);
  const Eigen::Matrix3d expected = (48.0 / 12 * edges.array().square()).matrix().asDiagonal();
  EXPECT_LT((moments.second_moment - expected).cwiseAbs().maxCoeff(), 48 * 36 * rounding);
  EXPECT_NEAR(surface_area(points, box.mesh.triangles), 2 * (8 + 12 + 24), 88 * rounding);
}

TEST(VolumeMoments, KeepTheirDigitsFarFromTheOrigin) {
  const auto sphere = icosphere(2, 1);
  const Eigen::Matrix3Xd points = Inclined{0, 2, 1.5, 0.7, 1.2, 30}.map() * sphere.points;
  const Eigen::Vector3d shift(1000, -2000, 500);
  const auto here = volume_moments(points, sphere.triangles);
  const auto there = volume_moments(points.colwise() + shift, sphere.triangles);
  // Coordinates of up to 2000 round by 2000 epsilon/2; a volume integral sees it times the area, about 13.
  const double shifted = 13 * 2000 * epsilon;
  EXPECT_NEAR(there.volume, here.volume, shifted);
  EXPECT_LT((there.centroid - here.centroid - shift).norm(), shifted);
  EXPECT_LT((there.second_moment - here.second_moment).cwiseAbs().maxCoeff(), 2 * shifted);
  EXPECT_NEAR(surface_area(points.colwise() + shift, sphere.triangles),
              surface_area(points, sphere.triangles), shifted);
  EXPECT_NEAR(deformation(there, 0, 2).deformation, deformation(here, 0, 2).deformation, shifted);
}

TEST(VolumeMoments, ChangeSignWithTheWinding) {
  const auto sphere = icosphere(1, 1), reversed = turned_inside_out(sphere);
  EXPECT_NEAR(volume_moments(reversed.points, reversed.triangles).volume,
              -volume_moments(sphere.points, sphere.triangles).volume, rounding);
}

/// Moments whose section in the x-z plane is given.
VolumeMoments section(double xx, double xz, double zz) {
  VolumeMoments moments;
  moments.volume = 1;
  moments.centroid.setZero();
  moments.second_moment << xx, 0, xz, 0, 1, 0, xz, 0, zz;
  return moments;
}

TEST(Deformation, OfACircleHasNoInclination) {
  EXPECT_EQ(deformation(section(2, 0, 2), 0, 2).inclination_deg, 0);
  EXPECT_EQ(deformation(section(2, 0, 2), 0, 2).deformation, 0);
  EXPECT_EQ(deformation(section(2, 3e-15, 2 - 1e-15), 0, 2).inclination_deg, 0)
      << "a circle but for rounding";
  const auto sphere = icosphere(3, 9.5, {30, 30, 30});
  EXPECT_EQ(deformation(volume_moments(sphere.points, sphere.triangles), 0, 2).inclination_deg, 0);
  EXPECT_NEAR(deformation(section(2, 1e-10, 2), 0, 2).inclination_deg, 45, 1e-4)
      << "but not a small deformation";
}

TEST(Deformation, AcrossTheFlowIsAtPlus90Degrees) {
  EXPECT_EQ(deformation(section(1, 0.0, 2), 0, 2).inclination_deg, 90);
  EXPECT_EQ(deformation(section(1, -0.0, 2), 0, 2).inclination_deg, 90);
  EXPECT_EQ(deformation(section(1, -1e-20, 2), 0, 2).inclination_deg, 90);
}

TEST(Deformation, RefusesAxesThatMakeNoPlane) {
  for (const auto& [flow, gradient] : {std::pair{0, 0}, {-1, 1}, {0, 3}})
    EXPECT_THROW(deformation(section(1, 0, 2), flow, gradient), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::membrane::test::shape_test
