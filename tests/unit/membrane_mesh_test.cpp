// The icosphere, the measures of a mesh, and the defects that are told apart.
#include "membrane/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> defects_of(const TriangleMesh& mesh) {
  return defects(inspect(mesh));
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both;
  both.points.resize(3, a.points.cols() + b.points.cols());
  both.points << a.points, b.points;
  both.triangles.resize(3, a.triangles.cols() + b.triangles.cols());
  both.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.points.cols())).matrix();
  return both;
}

TEST(Icosphere, HasTheCountsOfItsLevelAndNoDefect) {
  int n_triangles = 20;
  for (int level = 0; level <= 5; ++level, n_triangles *= 4) {
    const auto report = inspect(icosphere(level, 2.5, {1, 2, 3}));
    EXPECT_EQ(report.n_triangles, n_triangles);
    EXPECT_EQ(report.n_nodes, n_triangles / 2 + 2);
    EXPECT_EQ(report.n_edges, 3 * n_triangles / 2);
    EXPECT_EQ(report.euler_characteristic, 2);
    EXPECT_TRUE(report.closed && report.consistent_winding && report.outward);
    EXPECT_THAT(defects(report), IsEmpty());
  }
}

TEST(Icosphere, HasItsNodesOnTheSphereAndAlmostEqualEdges) {
  const Eigen::Vector3d centre(10, -20, 30);
  for (int level = 0; level <= 5; ++level) {
    const auto mesh = icosphere(level, 2.5, centre);
    // Coordinates of up to 32 round by 32 epsilon/2 each.
    EXPECT_LT(((mesh.points.colwise() - centre).colwise().norm().array() - 2.5).abs().maxCoeff(),
              32 * epsilon);
    const auto report = inspect(mesh);
    // Shortest are the edges along those of the icosahedron, which are arcs halved at each level. Longest are
    // those of the triangle in the middle of a face: one of chord c (radius 1) has in its own middle one of
    // chord c/sqrt(4 - c^2), so that 1/c^2 - 1/3 grows fourfold. Ends of an edge round by 16 epsilon a
    // coordinate each, and each level by a few times 2.5 epsilon.
    const double edge = 1 / std::sin(2 * std::numbers::pi / 5), arc = 2 * std::asin(0.5 * edge);
    const double longest = 1 / std::sqrt(1.0 / 3 + std::pow(4, level) * (1 / (edge * edge) - 1.0 / 3));
    const double shortest = 2 * std::sin(0.5 * arc / std::pow(2, level));
    const double rounding = (2 * 16 * std::sqrt(3.0) + 10 * level) * epsilon;
    EXPECT_NEAR(report.edge_max, 2.5 * longest, rounding) << level;
    EXPECT_NEAR(report.edge_min, 2.5 * shortest, rounding) << level;
    EXPECT_GE(report.edge_mean, report.edge_min * (1 - 100 * epsilon));
    EXPECT_LE(report.edge_mean, report.edge_max * (1 + 100 * epsilon));
  }
}

// Doing it again gives the same bits, and a level begins with the nodes of the level before: no number
// depends on the order of a hash or of an address.
TEST(Icosphere, NumbersItsNodesAlwaysAlike) {
  const auto coarse = icosphere(2, 1), fine = icosphere(3, 1), again = icosphere(3, 1);
  EXPECT_TRUE((fine.points.array() == again.points.array()).all());
  EXPECT_TRUE((fine.triangles.array() == again.triangles.array()).all());
  EXPECT_TRUE((fine.points.leftCols(coarse.points.cols()).array() == coarse.points.array()).all());
  // The first edge of the first triangle is halved first.
  const Eigen::Vector3d middle =
      (coarse.points.col(coarse.triangles(0, 0)) + coarse.points.col(coarse.triangles(1, 0))).normalized();
  EXPECT_TRUE((fine.points.col(coarse.points.cols()).array() == middle.array()).all());
}

TEST(Icosphere, RefusesALevelOrRadiusOutOfRange) {
  EXPECT_THROW(icosphere(-1, 1), std::invalid_argument);
  EXPECT_THROW(icosphere(9, 1), std::invalid_argument);
  EXPECT_THROW(icosphere(1, 0), std::invalid_argument);
  EXPECT_THROW(icosphere(1, std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_THROW(icosphere(1, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

// The icosahedron of circumradius 1: edge a = 1/sin(2 pi/5), area 5 sqrt(3) a^2, volume 5 (3 + sqrt(5))/12
// a^3.
TEST(MeshReport, MeasuresTheIcosahedron) {
  const Eigen::Vector3d centre(4, 5, 6);
  const auto report = inspect(icosphere(0, 1, centre));
  const double edge = 1 / std::sin(2 * std::numbers::pi / 5);
  const double rounding = 100 * epsilon;  // some ten operations on coordinates of up to 7
  EXPECT_NEAR(report.edge_min, edge, rounding);
  EXPECT_NEAR(report.edge_mean, edge, rounding);
  EXPECT_NEAR(report.edge_max, edge, rounding);
  EXPECT_NEAR(report.area, 5 * std::sqrt(3.0) * edge * edge, 2 * rounding);
  EXPECT_NEAR(report.volume, 5 * (3 + std::sqrt(5.0)) / 12 * std::pow(edge, 3), 2 * rounding);
  EXPECT_LT((report.centre - centre).norm(), rounding);
}

TEST(MeshDefects, FindAMissingTriangle) {
  auto mesh = icosphere(1, 1);
  mesh.triangles.conservativeResize(3, mesh.triangles.cols() - 1);
  EXPECT_THAT(defects_of(mesh), ElementsAre(AllOf(HasSubstr("surface is open"), HasSubstr("close it"))));
  EXPECT_FALSE(inspect(mesh).closed);
}

TEST(MeshDefects, FindAFlippedTriangle) {
  auto mesh = icosphere(1, 1);
  std::swap(mesh.triangles(0, 7), mesh.triangles(1, 7));
  EXPECT_THAT(defects_of(mesh),
              ElementsAre(AllOf(HasSubstr("wound against each other"), HasSubstr("orient"))));
  EXPECT_TRUE(inspect(mesh).closed);
  EXPECT_FALSE(inspect(mesh).consistent_winding);
}

TEST(MeshDefects, FindADuplicateNode) {
  auto mesh = icosphere(1, 1);
  mesh.points.conservativeResize(3, mesh.points.cols() + 1);
  mesh.points.rightCols<1>() = mesh.points.col(mesh.triangles(0, 5));
  mesh.triangles(0, 5) = static_cast<int>(mesh.points.cols()) - 1;
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("merge duplicate nodes")));
}

TEST(MeshDefects, FindASurfaceThatIsInsideOut) {
  const auto mesh = turned_inside_out(icosphere(0, 1));
  EXPECT_THAT(defects_of(mesh), ElementsAre(AllOf(HasSubstr("inside out (volume -2.536"),
                                                  HasSubstr("reverse every triangle"))));
  EXPECT_FALSE(inspect(mesh).outward);
}

TEST(MeshDefects, FindATriangleWithoutArea) {
  auto mesh = icosphere(1, 1);
  mesh.points.col(mesh.triangles(0, 3)) = mesh.points.col(mesh.triangles(1, 3));
  // Both triangles of that edge lose their area.
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("2 triangles have no area")));
}

TEST(MeshDefects, FindANodeOfNoTriangle) {
  auto mesh = icosphere(1, 1);
  mesh.points.conservativeResize(3, mesh.points.cols() + 2);
  mesh.points.rightCols<2>().setZero();
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("2 nodes belong to no triangle")));
  EXPECT_EQ(inspect(mesh).euler_characteristic, 2) << "they are no part of the surface";
}

TEST(MeshDefects, FindTwoSurfacesInOneMesh) {
  const auto mesh = joined(icosphere(1, 1), icosphere(0, 1, {5, 0, 0}));
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("is 2 separate parts (of 80, 20 triangles)")));
}

TEST(MeshDefects, FindTwoSpheresThatShareANode) {
  auto mesh = joined(icosphere(0, 1), icosphere(0, 1, {5, 0, 0}));
  for (int k = 0; k < mesh.triangles.size(); ++k)
    if (mesh.triangles.data()[k] == 23) mesh.triangles.data()[k] = 0;
  mesh.points.conservativeResize(3, 23);
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("2 separate parts (of 20, 20 triangles)"),
                                            HasSubstr("touch each other in 1 nodes")));
}

/// A torus of n x n squares, each of two triangles; wound outwards.
TriangleMesh torus(int n) {
  TriangleMesh mesh;
  mesh.points.resize(3, n * n);
  mesh.triangles.resize(3, 2 * n * n);
  const auto node = [n](int i, int j) { return i % n * n + j % n; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double along = 2 * std::numbers::pi * i / n, around = 2 * std::numbers::pi * j / n;
      const double distance = 3 + std::cos(around);
      mesh.points.col(node(i, j)) << distance * std::cos(along), distance * std::sin(along), std::sin(around);
      mesh.triangles.col(2 * node(i, j)) << node(i, j), node(i + 1, j), node(i + 1, j + 1);
      mesh.triangles.col(2 * node(i, j) + 1) << node(i, j), node(i + 1, j + 1), node(i, j + 1);
    }
  }
  return mesh;
}

TEST(MeshDefects, FindAHandle) {
  EXPECT_THAT(defects_of(torus(8)), ElementsAre(AllOf(HasSubstr("is 0, must be 2"), HasSubstr("handles"))));
}

// Numbers that add up over parts do not tell them.
TEST(MeshDefects, FindPartsThatTogetherHaveTheNumbersOfOneSphere) {
  const auto both = joined(torus(8), icosphere(0, 1, {9, 0, 0}));
  const auto report = inspect(both);
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_TRUE(report.closed && report.consistent_winding && report.outward);
  ASSERT_EQ(report.parts.size(), 2);
  EXPECT_EQ(report.parts[0].n_triangles, 128);
  EXPECT_EQ(report.parts[0].euler_characteristic, 0);
  EXPECT_EQ(report.parts[1].n_triangles, 20);
  EXPECT_EQ(report.parts[1].euler_characteristic, 2);
  EXPECT_NEAR(report.parts[0].volume + report.parts[1].volume, report.volume, 1e-12 * report.volume);
  EXPECT_THAT(defects(report), ElementsAre(HasSubstr("is 2 separate parts (of 128, 20 triangles)")));
  // A part that is inside out is not hidden by the volume of the other.
  const auto hollow = inspect(joined(icosphere(1, 5), turned_inside_out(icosphere(0, 1))));
  EXPECT_GT(hollow.volume, 0);
  EXPECT_LT(hollow.parts[1].volume, 0);
  EXPECT_THAT(defects(hollow), ElementsAre(HasSubstr("2 separate parts")));
}

TEST(MeshDefects, FindASphereThatTouchesItselfInANode) {
  auto mesh = icosphere(1, 1);
  // The ends of an axis become one node: a sphere pinched together in the middle.
  int low = 0, high = 0;
  mesh.points.row(2).minCoeff(&low);
  mesh.points.row(2).maxCoeff(&high);
  for (int k = 0; k < mesh.triangles.size(); ++k)
    if (mesh.triangles.data()[k] == high) mesh.triangles.data()[k] = low;
  EXPECT_EQ(inspect(mesh).n_pinched_nodes, 1);
  EXPECT_EQ(inspect(mesh).parts.size(), 1);
  EXPECT_THAT(defects_of(mesh), ::testing::Contains(HasSubstr("touch each other in 1 nodes")));
}

TEST(MeshDefects, FindASurfaceWithoutAVolume) {
  auto mesh = icosphere(2, 1);
  mesh.points.row(2) *= 1e-10;
  EXPECT_THAT(defects_of(mesh), ElementsAre(HasSubstr("encloses no volume")));
  mesh = icosphere(2, 1);
  mesh.points.row(2) *= 1e-3;
  EXPECT_THAT(defects_of(mesh), IsEmpty());
}

TEST(MeshReport, RefusesWhatIsNoMesh) {
  const auto message = [](const TriangleMesh& mesh) -> std::string {
    try {
      inspect(mesh);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  auto mesh = icosphere(0, 1);
  mesh.triangles(2, 4) = 12;
  EXPECT_THAT(message(mesh), HasSubstr("names a node outside 0 .. 11"));
  mesh.triangles(2, 4) = -1;
  EXPECT_THAT(message(mesh), HasSubstr("names a node outside 0 .. 11"));
  mesh = icosphere(0, 1);
  mesh.points(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(mesh), HasSubstr("not finite"));
  mesh.triangles.resize(3, 0);
  EXPECT_THAT(message(mesh), HasSubstr("no triangles"));
}

}  // namespace
}  // namespace tanktread::membrane::test
