// Forces at the ends of a surface: which nodes they are on, and what they add up to.
#include "membrane/end_loads.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "membrane/node_areas.hpp"
#include "membrane/shape.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::end_loads_test {
namespace {

const Eigen::Vector3d oblique(0.3, -1.1, 0.7);
const Eigen::Vector3d place(30.2, 17.7, 41.3);

/// A radius of 10 and places up to 50: places along an axis are rounded by less than 100 epsilons, sums of
/// some hundred shares by as much again.
constexpr double rounding = 1000 * epsilon;

Eigen::Vector3d moment_of(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& forces) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index node = 0; node < points.cols(); ++node)
    moment += (points.col(node) - place).cross(forces.col(node));
  return moment;
}

/// The mesh with its nodes numbered the other way round.
TriangleMesh renumbered(const TriangleMesh& mesh) {
  TriangleMesh other;
  other.points = mesh.points.rowwise().reverse();
  other.triangles = (static_cast<int>(mesh.points.cols()) - 1) - mesh.triangles.array();
  return other;
}

TEST(NodeAreas, AddUpToTheSurface) {
  const auto mesh = icosphere(3, 10, place);
  const auto areas = node_areas(mesh.points, mesh.triangles);
  EXPECT_NEAR(areas.sum(), surface_area(mesh.points, mesh.triangles), rounding * areas.sum());
  // Of a cube of two triangles a face every corner has between 3 and 6 triangles of area 1/2, a third of
  // each.
  const auto box = cube(1).mesh;
  const auto of_corners = node_areas(box.points, box.triangles);
  EXPECT_NEAR(of_corners.sum(), 6, rounding);
  EXPECT_GE(of_corners.minCoeff(), 0.5 - rounding);
  EXPECT_LE(of_corners.maxCoeff(), 1 + rounding);
}

TEST(EndLoads, AreOnTheNodesFarthestAlongTheAxis) {
  const auto mesh = icosphere(4, 10, place);
  const auto areas = node_areas(mesh.points, mesh.triangles);
  for (const double share : {1e-6, 0.02, 0.2}) {
    const auto patches = end_patches(mesh, oblique, share);
    const Eigen::VectorXd along = mesh.points.transpose() * patches.direction;
    for (const auto* patch : {&patches.ahead, &patches.behind}) {
      const double sign = patch == &patches.ahead ? 1 : -1;
      double area = 0, nearest = 1e9, largest = 0;
      for (const auto node : patch->nodes) {
        area += areas[node];
        nearest = std::min(nearest, sign * along[node]);
        largest = std::max(largest, areas[node]);
      }
      EXPECT_NEAR(patch->area, area, rounding * area);
      EXPECT_NEAR(patch->share.sum(), 1, rounding);
      EXPECT_NEAR(patch->width, (sign * along).maxCoeff() - nearest, 1e-8);
      EXPECT_GE(area, share * areas.sum() * (1 - rounding));
      // Without its nearest node (an oblique axis has no ties) it is too small.
      EXPECT_LT(area - largest, std::max(share * areas.sum(), 1e-9));
      for (Eigen::Index node = 0; node < along.size(); ++node) {
        const bool is_in = std::ranges::binary_search(patch->nodes, node);
        EXPECT_EQ(is_in, sign * along[node] >= nearest) << node;
      }
    }
  }
}

TEST(EndLoads, OnASphereAreTheCap) {
  // A cap of the share s of a sphere is 2 s R high; a row of nodes more or less is an edge (0.6 of R/10).
  const auto patches = end_patches(icosphere(5, 10, place), oblique, 0.05);
  EXPECT_NEAR(patches.ahead.width, 1.0, 0.3);
  EXPECT_NEAR(patches.ahead.area / patches.mesh_area, 0.05, 0.002);
}

TEST(EndLoads, AddUpToNothingAndByUnitsOfTheForce) {
  const auto mesh = icosphere(4, 10, place);
  const auto patches = end_patches(mesh, oblique, 0.02);
  const auto forces = end_forces(patches, -3.5, mesh.points.cols());
  EXPECT_LT(forces.rowwise().sum().norm(), rounding);
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
  for (const auto node : patches.ahead.nodes) ahead += forces.col(node);
  EXPECT_LT((ahead + 3.5 * oblique.normalized()).norm(), rounding);
  // On the nodes of the patches only, in proportion to their areas.
  const auto areas = node_areas(mesh.points, mesh.triangles);
  const auto n_loaded = (forces.colwise().norm().array() > 0).count();
  EXPECT_EQ(n_loaded, std::ssize(patches.ahead.nodes) + std::ssize(patches.behind.nodes));
  for (const auto node : patches.behind.nodes)
    EXPECT_NEAR(forces.col(node).norm(), 3.5 * areas[node] / patches.behind.area, rounding);
}

TEST(EndLoads, MomentIsTheForceTimesTheOffset) {
  auto mesh = icosphere(4, 10, place);
  mesh.points = smoothly_deformed(mesh.points);
  const auto patches = end_patches(mesh, oblique, 0.03);
  const auto forces = end_forces(patches, 2, mesh.points.cols());
  EXPECT_GT(patches.offset(), 0.1);  // without symmetry there is a moment
  EXPECT_NEAR(moment_of(mesh.points, forces).norm(), 2 * patches.offset(), 1e4 * rounding);
}

TEST(EndLoads, HaveNoMomentOnASymmetricShape) {
  // The axes of an icosphere's coordinates are two-fold axes, wherever it is placed.
  for (const double share : {0.002, 0.02, 0.21, 0.5}) {
    const auto mesh = icosphere(3, 10, place);
    for (int axis = 0; axis < 3; ++axis) {
      const auto patches = end_patches(mesh, Eigen::Vector3d::Unit(axis), share);
      EXPECT_LT(patches.offset(), rounding) << axis << " " << share;
      EXPECT_EQ(patches.ahead.nodes.size(), patches.behind.nodes.size());
      EXPECT_LT(moment_of(mesh.points, end_forces(patches, 1, mesh.points.cols())).norm(), rounding);
    }
  }
}

TEST(EndLoads, TakeAllNodesThatAreEquallyFar) {
  // The four corners of a cube's face, however little is asked for; and the same on any numbering and place.
  auto box = cube(3).mesh;
  box.points.colwise() += place;
  const auto patches = end_patches(box, {2, 0, 0}, 0.01);
  EXPECT_EQ(patches.ahead.nodes.size(), 4u);
  EXPECT_NEAR(patches.ahead.width, 0, rounding);
  EXPECT_NEAR(patches.ahead.centroid.x(), place.x() + 3, rounding);
  // A rounding of their places is no difference.
  auto rounded = box;
  rounded.points = randomly_moved(box.points, 1e-13, 7);
  EXPECT_EQ(end_patches(rounded, {2, 0, 0}, 0.01).ahead.nodes, patches.ahead.nodes);
  const auto mesh = icosphere(3, 10, place), other = renumbered(mesh);
  for (const double share : {0.005, 0.02, 0.1, 0.3}) {
    const auto one = end_patches(mesh, {0, 0, 1}, share), two = end_patches(other, {0, 0, 1}, share);
    std::vector<Eigen::Index> back;
    for (const auto node : two.ahead.nodes) back.push_back(mesh.points.cols() - 1 - node);
    std::ranges::sort(back);
    EXPECT_EQ(back, one.ahead.nodes) << share;
  }
}

TEST(EndLoads, DoNotDependOnTheLengthOfTheDirection) {
  const auto mesh = icosphere(3, 10, place);
  const auto patches = end_patches(mesh, oblique, 0.02);
  for (const double length : {1e-200, 1e200}) {
    const auto other = end_patches(mesh, length * oblique, 0.02);
    EXPECT_EQ(other.ahead.nodes, patches.ahead.nodes);
    EXPECT_LT((other.direction - patches.direction).norm(), rounding);
  }
}

TEST(EndLoads, RefuseWhatIsNone) {
  const auto mesh = icosphere(1, 1);
  EXPECT_EQ(refusal_message([&] { end_patches(mesh, Eigen::Vector3d::Zero(), 0.1); }),
            "end loads: the direction must be finite and not zero");
  for (const double share : {0.0, -0.1, 0.51, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refusal_message([&] { end_patches(mesh, oblique, share); }).find("at most 0.5"),
              std::string::npos);
}

}  // namespace
}  // namespace tanktread::membrane::test::end_loads_test
