// How a mesh of a body of revolution comes to the volume and area of the body.
#include <gtest/gtest.h>

#include <cmath>

#include "membrane/revolved_mesh.hpp"
#include "membrane/shape.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// Relative errors of volume and area.
Eigen::Array2d errors_at(const Meridian& meridian, int level) {
  const auto mesh = revolved_mesh(meridian, level);
  return {volume_moments(mesh.points, mesh.triangles).volume / volume(meridian) - 1,
          surface_area(mesh.points, mesh.triangles) / surface_area(meridian) - 1};
}

// Flat triangles with their nodes on a surface: the layer between is of order 2 in the edge. From level 4 to
// 5 edges are halved to 1e-3, and the next term, of order 4, is (edge times curvature)^2, here up to (0.1 x
// 3)^2: off by up to 0.1.
TEST(RevolvedMeshConvergence, OfVolumeAndAreaIsOfOrderTwo) {
  for (const auto& meridian : {biconcave_meridian(1), spheroid_meridian(1, 0.5), spheroid_meridian(1, 2)}) {
    const Eigen::Array2d coarse = errors_at(meridian, 4), fine = errors_at(meridian, 5);
    const Eigen::Array2d order = (coarse / fine).log() / std::log(2);
    EXPECT_NEAR(order[0], 2, 0.1) << coarse.transpose() << "; " << fine.transpose();
    EXPECT_NEAR(order[1], 2, 0.1) << coarse.transpose() << "; " << fine.transpose();
  }
}

}  // namespace
}  // namespace tanktread::membrane::test
