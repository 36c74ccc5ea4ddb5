// Distances of triangles and of surfaces whose exact answers are known, and what lies inside what.
#include "membrane/placed_surface.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "membrane/element.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3d corners;
  corners << a, b, c;
  return corners;
}

struct TrianglePair {
  const char* what;
  Matrix3d other;  ///< to the triangle (0, 0, 0), (4, 0, 0), (0, 4, 0)
  double distance;
  std::optional<Vector3d> place;  ///< nothing: not one place
};

TEST(TriangleDistance, IsTheExactOneInEveryPosition) {
  const auto low = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const std::vector<TrianglePair> all = {
      {"a corner above the face", triangle({1, 1, 3}, {1, 2, 5}, {2, 1, 5}), 3, Vector3d(1, 1, 1.5)},
      {"edges that pass each other", triangle({2, -1, 2}, {2, -1, -2}, {2, -9, 0}), 1, Vector3d(2, -0.5, 0)},
      {"corner to corner", triangle({-3, -4, 0}, {-9, -4, 0}, {-3, -9, 0}), 5, Vector3d(-1.5, -2, 0)},
      {"a corner beside an edge", triangle({3, 3, 0}, {9, 4, 0}, {4, 9, 0}), std::sqrt(2.0),
       Vector3d(2.5, 2.5, 0)},
      {"an edge through the face", triangle({1, 1, -1}, {1, 1, 2}, {9, 9, 1}), 0, std::nullopt},
      {"the face through the other's edge", triangle({-1, 1, -1}, {-1, 1, 1}, {3, 1, 0}), 0, std::nullopt},
      {"in one plane, one within the other", triangle({0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}), 0,
       std::nullopt},
      {"in one plane, apart", triangle({-2, 0, 0}, {-2, 4, 0}, {-9, 0, 0}), 2, std::nullopt},
      {"touching with a corner", triangle({1, 1, 0}, {1, 2, 5}, {2, 1, 5}), 0, Vector3d(1, 1, 0)},
      {"parallel above", triangle({0, 0, 7}, {4, 0, 7}, {0, 4, 7}), 7, std::nullopt},
  };
  // All numbers are of a few bits; products of up to three round by a few epsilon of at most 9^3.
  const double rounding = 1000 * epsilon;
  for (const auto& pair : all) {
    for (int turn = 0; turn < 6; ++turn) {  // whichever corner comes first, and whichever way it is wound
      Matrix3d other;
      for (int k = 0; k < 3; ++k)
        other.col(k) = pair.other.col(turn < 3 ? (k + turn) % 3 : (5 + turn - k) % 3);
      for (const auto& found : {nearest_place(low, other), nearest_place(other, low)}) {
        EXPECT_NEAR(found.distance, pair.distance, rounding) << pair.what;
        if (pair.place) {
          EXPECT_LT((found.place - *pair.place).norm(), rounding) << pair.what;
        }
      }
    }
  }
}

/// Of all pairs of triangles.
double nearest_of_all(const TriangleMesh& a, const TriangleMesh& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int s = 0; s < a.triangles.cols(); ++s) {
    for (int t = 0; t < b.triangles.cols(); ++t) {
      const auto found =
          nearest_place(corners_of(a.points, a.triangles.col(s)), corners_of(b.points, b.triangles.col(t)));
      nearest = std::min(nearest, found.distance);
    }
  }
  return nearest;
}

/// Without a limit.
NearestPlace nearest(const PlacedSurface& a, const PlacedSurface& b,
                     const Vector3d& shift = Vector3d::Zero()) {
  return a.nearest_to(b, shift, std::numeric_limits<double>::infinity()).value();
}

TEST(PlacedSurface, FindsTheNearestOfAllPairsOfTriangles) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    auto first = icosphere(2, 3), second = icosphere(1, 2);
    first.points = randomly_moved(smoothly_deformed(first.points), 0.1, seed);
    second.points = randomly_moved(second.points, 0.1, seed + 100);
    // From far away to far within each other.
    for (const double x : {9.0, 6.0, 5.0, 4.0}) {
      auto moved = second;
      moved.points.colwise() += Vector3d(x, 0.5, -0.3);
      EXPECT_EQ(nearest(PlacedSurface(first), PlacedSurface(moved)).distance, nearest_of_all(first, moved));
    }
  }
}

TEST(PlacedSurface, SpheresHaveTheDistanceOfTheirPoles) {
  // From level 1 on, each has a node on every axis, and lies within its sphere.
  const PlacedSurface first(icosphere(3, 5, {10, 20, 30}));
  for (const double apart : {10 + 1e-6, 11.0, 14.0}) {
    const PlacedSurface second(icosphere(2, 5, {10 + apart, 20, 30}));
    const auto found = nearest(first, second);
    EXPECT_NEAR(found.distance, apart - 10, 40 * epsilon) << "coordinates of up to 30 round by 32 epsilon/2";
    EXPECT_LT((found.place - Vector3d(10 + 0.5 * apart, 20, 30)).norm(), 60 * epsilon);
  }
  for (const double apart : {10 - 1e-6, 9.0, 5.0})
    EXPECT_EQ(nearest(first, PlacedSurface(icosphere(2, 5, {10 + apart, 20, 30}))).distance, 0);
}

TEST(PlacedSurface, AreNowhereNearerThanALimit) {
  const PlacedSurface ball(icosphere(3, 5));
  const Vector3d apart(12, 0, 0);
  EXPECT_TRUE(ball.nearest_to(ball, apart, 2 + 1e-6));
  EXPECT_FALSE(ball.nearest_to(ball, apart, 2 - 1e-6));
  // The boxes around them overlap, the balls do not: they are sqrt(2) 9 - 10 apart.
  EXPECT_FALSE(ball.nearest_to(ball, {9, 9, 0}, 2));
  EXPECT_TRUE(ball.nearest_to(ball, {9, 9, 0}, 3));
}

TEST(PlacedSurface, ThinDiscsAreFarApartOneWayAndCutThroughEachOtherTheOther) {
  auto disc = icosphere(3, 4);
  disc.points.row(2) *= 0.25;  // semi-axes 4, 4, 1
  const PlacedSurface placed(disc);
  EXPECT_NEAR(nearest(placed, placed, {0, 0, 2.5}).distance, 0.5, 10 * epsilon);
  EXPECT_NEAR(nearest(placed, placed, {8.5, 0, 0}).distance, 0.5, 10 * epsilon);
  EXPECT_EQ(nearest(placed, placed, {7.5, 0, 0}).distance, 0);
  EXPECT_EQ(nearest(placed, placed, {0, 0, 1.9}).distance, 0);
}

TEST(PlacedSurface, EnclosesWhatLiesInside) {
  const PlacedSurface box(cube(8).mesh);
  for (const double x : {-1.0, 0.1, 4.0, 7.9, 9.0}) {
    for (const double y : {-1.0, 0.1, 4.0, 7.9, 9.0}) {
      const bool inside = x > 0 && x < 8 && y > 0 && y < 8;
      EXPECT_EQ(box.encloses(Vector3d(x, y, 3)), inside) << x << " " << y;
    }
  }
  const PlacedSurface small(icosphere(2, 1));
  EXPECT_TRUE(box.encloses(small, {4, 4, 4}));
  EXPECT_FALSE(box.encloses(small, {-4, 4, 4}));
  EXPECT_FALSE(small.encloses(box, {-4, -4, -4}));
  // Within the box around a ball, but outside of the ball.
  const PlacedSurface ball(icosphere(3, 8));
  EXPECT_FALSE(ball.encloses(small, {6, 6, 6}));
  EXPECT_TRUE(ball.encloses(small, {0, 6, 0}));
}

}  // namespace
}  // namespace tanktread::membrane::test
