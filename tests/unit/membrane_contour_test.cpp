// The contour in which a plane cuts a surface, and what moves with it: cases that are known exactly.
#include "membrane/contour.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "membrane/shape.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::contour_test {
namespace {

/// Some hundred terms of about 1 add up.
constexpr double rounding = 1000 * epsilon;

double length_at(const TriangleMesh& mesh, int axis, double at) {
  return contour_length(mesh.points, contour(mesh.points, mesh.triangles, axis, at));
}

/// How often each cut edge ends a piece: twice where the curves are closed.
std::map<std::pair<int, int>, int> ends_of(const std::vector<ContourPiece>& pieces) {
  std::map<std::pair<int, int>, int> ends;
  for (const auto& piece : pieces) {
    for (const auto& end : {piece.begin, piece.end}) ++ends[{end.low, end.high}];
  }
  return ends;
}

TEST(Contour, OfACubeIsASquare) {
  const auto box = cube(2).mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {0.3, 1.0, 1.999}) EXPECT_NEAR(length_at(box, axis, at), 8, rounding);
    EXPECT_EQ(length_at(box, axis, -0.1), 0);
    EXPECT_EQ(length_at(box, axis, 2.1), 0);
    // Nodes on the plane are above it: the square at their ends is that of the highest face.
    EXPECT_NEAR(length_at(box, axis, 2), 8, rounding);
    EXPECT_EQ(length_at(box, axis, 0), 0);
  }
}

TEST(Contour, IsClosedWhereverThePlaneLies) {
  auto mesh = icosphere(3, 1);
  mesh.points = smoothly_deformed(mesh.points);
  for (int axis = 0; axis < 3; ++axis) {
    // Through nodes, and between them.
    for (const double at : {mesh.points(axis, 0), mesh.points(axis, 100), 0.05}) {
      const auto pieces = contour(mesh.points, mesh.triangles, axis, at);
      EXPECT_GT(pieces.size(), 5u);
      for (const auto& [edge, times] : ends_of(pieces)) EXPECT_EQ(times, 2);
      for (const auto& piece : pieces) {
        EXPECT_NEAR(piece.begin.of(mesh.points)[axis], at, rounding);
        EXPECT_NEAR(piece.end.of(mesh.points)[axis], at, rounding);
      }
    }
  }
}

TEST(Contour, OfSeveralCurvesIsAllOfThem) {
  const auto one = icosphere(2, 1), other = icosphere(2, 0.7, {5, 0, 0});
  TriangleMesh both;
  both.points.resize(3, one.points.cols() + other.points.cols());
  both.points << one.points, other.points;
  both.triangles.resize(3, one.triangles.cols() + other.triangles.cols());
  both.triangles << one.triangles, (other.triangles.array() + static_cast<int>(one.points.cols())).matrix();
  EXPECT_NEAR(length_at(both, 1, 0.1), length_at(one, 1, 0.1) + length_at(other, 1, 0.1), rounding);
  EXPECT_GT(length_at(other, 1, 0.1), 4);
}

TEST(MeanSpeed, OfATranslationIsItsPartInThePlane) {
  const auto mesh = icosphere(2, 1.5);
  const Eigen::Vector3d frame(0.3, -0.2, 0.7);
  const Eigen::Matrix3Xd velocity = (frame + Eigen::Vector3d(3, 12, -4)).replicate(1, mesh.points.cols());
  const auto pieces = contour(mesh.points, mesh.triangles, 1, 0.2);
  EXPECT_NEAR(mean_speed(mesh.points, velocity, pieces, 1, frame), 5, 5 * rounding);
  EXPECT_EQ(mean_speed(mesh.points, velocity, {}, 1, frame), 0);
}

// An affine velocity maps a solid to one whose centroid goes with it, also where the volume changes.
TEST(CentroidVelocity, IsThatOfTheMapOfTheVolume) {
  auto mesh = icosphere(2, 1.3, {7, -2, 4});
  mesh.points = smoothly_deformed(mesh.points);
  Eigen::Matrix3d gradient;
  gradient << 0.3, -1.2, 0.4, 0.9, 0.5, -0.3, 0.2, 0.8, -0.1;
  const Eigen::Vector3d drift(0.2, -0.1, 0.05);
  const Eigen::Matrix3Xd velocity = (gradient * mesh.points).colwise() + drift;
  const auto moments = volume_moments(mesh.points, mesh.triangles);
  const Eigen::Vector3d expected = gradient * moments.centroid + drift;
  const auto found = centroid_velocity(moments, mesh.points, mesh.triangles, velocity);
  EXPECT_LT((found - expected).norm(), 20 * rounding);
}

// A small move of the nodes by any velocities, held against the centroid before and after: of second order in
// the move, by central differences.
TEST(CentroidVelocity, IsTheRateOfTheCentroidForAnyVelocities) {
  const auto mesh = icosphere(2, 1, {1, 2, 3});
  const Eigen::Matrix3Xd velocity = randomly_moved(mesh.points, 0.3, 5) - mesh.points;
  const auto centroid = [&](double time) -> Eigen::Vector3d {
    return volume_moments(mesh.points + time * velocity, mesh.triangles).centroid;
  };
  constexpr double time = 1e-4;
  const Eigen::Vector3d expected = (centroid(time) - centroid(-time)) / (2 * time);
  const auto found =
      centroid_velocity(volume_moments(mesh.points, mesh.triangles), mesh.points, mesh.triangles, velocity);
  // time^2 of velocities of 0.3 a node, and the rounding of 4 in the centroid by 2 time.
  EXPECT_LT((found - expected).norm(), time * time + 4 * rounding);
  EXPECT_GT(expected.norm(), 1e-3);
}

TEST(NearestNode, IsTheFirstOfSeveral) {
  const auto box = cube(2).mesh;
  EXPECT_EQ(nearest_node(box.points, {1, 1, 1}), 0);
  for (Eigen::Index node = 0; node < box.points.cols(); ++node)
    EXPECT_EQ(nearest_node(box.points, 1.2 * box.points.col(node)), node);
}

}  // namespace
}  // namespace tanktread::membrane::test::contour_test
