// Meshes of bodies of revolution: nodes on the surface, triangles that are good everywhere, exact mirror
// images.
#include "membrane/revolved_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using testing::IsEmpty;

std::vector<Meridian> all_meridians() {
  return {biconcave_meridian(2.5),      spheroid_meridian(2.5, 0.1), spheroid_meridian(2.5, 0.5),
          spheroid_meridian(2.5, 0.97), spheroid_meridian(2.5, 2),   spheroid_meridian(2.5, 10)};
}

TEST(RevolvedMesh, IsAMembraneWithTheTrianglesOfTheSphere) {
  for (const auto& meridian : all_meridians()) {
    for (int level = 0; level <= 5; ++level) {
      const auto mesh = revolved_mesh(meridian, level);
      EXPECT_EQ(mesh.triangles, icosphere(level, 1).triangles);
      const auto report = inspect(mesh);
      EXPECT_THAT(defects(report), IsEmpty());
      EXPECT_TRUE(report.outward);
      // Mirror images cancel but for rounding: of each term, of lengths up to 12, and of each sum so far.
      EXPECT_LT(report.centre.norm(), 12 * epsilon * report.n_triangles);
    }
  }
}

TEST(RevolvedMesh, HasTheNodesOfTheRedCellOnThePublishedShape) {
  const auto meridian = biconcave_meridian(1);
  const double micrometre = 3.91 / meridian.rim;
  const Eigen::Matrix3Xd points = micrometre * revolved_mesh(meridian, 4).points;
  for (const auto& point : points.colwise()) {
    const double x2 = point.head<2>().squaredNorm() / (3.91 * 3.91);
    const double polynomial = 0.81 + 7.83 * x2 - 4.39 * x2 * x2;
    // The thickness squared, for its root is steep at the rim. The polynomial is at most 4.4 and rounds by
    // some ten epsilon, so the product by twice that times 4.4.
    EXPECT_NEAR(4 * point[2] * point[2], (1 - x2) * polynomial * polynomial, 2 * 10 * 4.4 * 4.4 * epsilon);
  }
}

TEST(RevolvedMesh, HasTheNodesOfASpheroidOnIt) {
  for (const double ratio : {0.1, 0.5, 2.0, 10.0}) {
    const auto meridian = spheroid_meridian(2.5, ratio);
    const auto mesh = revolved_mesh(meridian, 3);
    const Eigen::Vector3d axes(meridian.rim, meridian.rim, meridian.heights[0]);
    for (const auto& point : mesh.points.colwise())
      EXPECT_NEAR(point.cwiseQuotient(axes).squaredNorm(), 1, 10 * epsilon);
  }
}

TEST(RevolvedMesh, OfASphereIsTheIcosphere) {
  const auto sphere = icosphere(4, 2.5), revolved = revolved_mesh(spheroid_meridian(2.5, 1), 4);
  // An angle rounds by an epsilon of up to pi/2, its length in 128 panels as the sums of the meridian's
  // length do.
  EXPECT_LT((sphere.points - revolved.points).cwiseAbs().maxCoeff(), 2.5 * 128 * epsilon);
}

TEST(RevolvedMesh, IsItsOwnMirrorImageToTheLastBit) {
  for (const auto& meridian : all_meridians()) {
    const auto mesh = revolved_mesh(meridian, 3);
    std::set<std::tuple<double, double, double>> nodes;
    for (const auto& p : mesh.points.colwise()) nodes.insert({p[0], p[1], p[2]});
    ASSERT_EQ(static_cast<Eigen::Index>(nodes.size()), mesh.points.cols());
    for (const auto& [x, y, z] : nodes)
      EXPECT_TRUE(nodes.contains({-x, y, z}) && nodes.contains({x, -y, z}) && nodes.contains({x, y, -z}));
  }
}

struct Quality {
  double worst;            ///< longest edge by its height, over that of an equilateral triangle
  double least, greatest;  ///< edges over their mean
};

Quality quality_of(const TriangleMesh& mesh) {
  Quality quality{0, 0, 0};
  for (const auto& triangle : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.points.col(triangle[0]), b = mesh.points.col(triangle[1]),
                          c = mesh.points.col(triangle[2]);
    const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const double height = (b - a).cross(c - a).norm() / longest;
    quality.worst = std::max(quality.worst, longest / height * std::sqrt(0.75));
  }
  const auto report = inspect(mesh);
  quality.least = report.edge_min / report.edge_mean;
  quality.greatest = report.edge_max / report.edge_mean;
  return quality;
}

// The table of revolved_mesh.hpp, to its last digit.
TEST(RevolvedMesh, HasTrianglesAsGoodAsStated) {
  struct Stated {
    Meridian meridian;
    std::array<Quality, 4> of_level;  // 2 to 5
  };
  const std::vector<Stated> table = {
      {biconcave_meridian(1),
       {{{1.49, 0.85, 1.26}, {1.53, 0.85, 1.29}, {1.54, 0.85, 1.30}, {1.54, 0.85, 1.30}}}},
      {spheroid_meridian(1, 0.2),
       {{{1.75, 0.67, 1.32}, {1.75, 0.79, 1.40}, {1.79, 0.80, 1.44}, {1.79, 0.81, 1.46}}}},
      {spheroid_meridian(1, 0.5),
       {{{1.50, 0.84, 1.25}, {1.55, 0.84, 1.29}, {1.57, 0.85, 1.31}, {1.57, 0.85, 1.31}}}},
      {spheroid_meridian(1, 2),
       {{{1.92, 0.69, 1.26}, {1.93, 0.69, 1.26}, {1.94, 0.69, 1.26}, {1.94, 0.69, 1.26}}}},
      {spheroid_meridian(1, 5),
       {{{4.16, 0.38, 1.52}, {4.19, 0.38, 1.52}, {4.20, 0.38, 1.52}, {4.21, 0.38, 1.52}}}},
  };
  for (const auto& [meridian, of_level] : table) {
    for (int level = 2; level <= 5; ++level) {
      const auto found = quality_of(revolved_mesh(meridian, level)), stated = of_level[level - 2];
      const double digit = 0.00501;
      EXPECT_NEAR(found.worst, stated.worst, digit) << level;
      EXPECT_NEAR(found.least, stated.least, digit) << level;
      EXPECT_NEAR(found.greatest, stated.greatest, digit) << level;
    }
  }
}

TEST(RevolvedMesh, RefusesALevelOutOfRange) {
  EXPECT_THROW(revolved_mesh(Meridian(), -1), std::invalid_argument);
  EXPECT_THROW(revolved_mesh(Meridian(), 9), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::membrane::test
