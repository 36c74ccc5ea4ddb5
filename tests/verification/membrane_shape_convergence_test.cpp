// Order of convergence of the measures of a shape with the edge length.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "membrane/shape.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::shape_convergence_test {
namespace {

constexpr double long_axis = 1.5, breadth_axis = 1.2, short_axis = 0.7, inclination = 0.4;

/// Nodes on an ellipsoid inclined in the x-z plane, each where the ray from the centre through a node of the
/// icosphere meets it. Not a linear image of the icosphere, whose D would be exact on any mesh.
TriangleMesh ellipsoid(int level) {
  auto mesh = icosphere(level, 1);
  const Eigen::Matrix3d axes = rotation({0, 1, 0}, -inclination);
  const Eigen::Vector3d semi_axes(long_axis, breadth_axis, short_axis);
  for (Eigen::Index node = 0; node < mesh.points.cols(); ++node) {
    const Eigen::Vector3d direction = axes.transpose() * mesh.points.col(node);
    mesh.points.col(node) /= direction.cwiseQuotient(semi_axes).norm();
  }
  return mesh;
}

/// Errors of volume, D, inclination, length, width, breadth, and of the area of the sphere.
constexpr std::array names = {"volume", "deformation", "inclination", "length", "width", "breadth", "area"};
using Errors = std::array<double, names.size()>;

Errors errors_at(int level) {
  const auto mesh = ellipsoid(level);
  const auto moments = volume_moments(mesh.points, mesh.triangles);
  const auto shape = deformation(moments, 0, 2);
  const auto sphere = icosphere(level, 1);
  return {moments.volume - 4 * std::numbers::pi / 3 * long_axis * breadth_axis * short_axis,
          shape.deformation - (long_axis - short_axis) / (long_axis + short_axis),
          shape.inclination_deg - inclination * 180 / std::numbers::pi,
          shape.length - long_axis,
          shape.width - short_axis,
          shape.breadth - breadth_axis,
          surface_area(sphere.points, sphere.triangles) - 4 * std::numbers::pi};
}

// The facets leave out a layer whose thickness goes with the square of the edge: order 2. From level 4 to 5
// the next term, of order 4, is (edge/radius)^2 < 1 % of the error for curvatures of 1; at the tips of this
// ellipsoid the curvature is 3, so the order may be off by up to 0.1.
TEST(ShapeConvergence, IsOfOrderTwoInTheEdge) {
  const auto coarse = errors_at(4), fine = errors_at(5);
  const double refinement = inspect(ellipsoid(4)).edge_mean / inspect(ellipsoid(5)).edge_mean;
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_NEAR(std::log(coarse[k] / fine[k]) / std::log(refinement), 2.0, 0.1) << names[k];
  }
}

// What a user meets at the 5120 triangles of level 4: D = 0.36 off by 0.001, the angle by less than 0.001
// degrees.
TEST(ShapeConvergence, LeavesASmallErrorAtLevelFour) {
  const auto errors = errors_at(4);
  EXPECT_LT(std::abs(errors[1]), 1e-3);
  EXPECT_LT(std::abs(errors[2]), 1e-3);
}

}  // namespace
}  // namespace tanktread::membrane::test::shape_convergence_test
