// Marks against the winding number by solid angles, for shapes of all kinds, anywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/unit/coupler_closed_surfaces.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

struct Shape {
  std::string name;
  Surface surface;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"sphere", ellipsoid(2, {6.1, 6.1, 6.1})},       {"small sphere", ellipsoid(3, {0.9, 0.9, 0.9})},
      {"ellipsoid", ellipsoid(2, {3.1, 5.3, 7.9})},    {"needle", ellipsoid(2, {0.4, 0.6, 8.9})},
      {"plate", ellipsoid(2, {8.3, 7.7, 0.3})},        {"biconcave disc", biconcave_disc(3, 8.2)},
      {"stomatocyte", stomatocyte(3, 6.3, 3.1)},       {"thin stomatocyte", stomatocyte(3, 7.3, 0.9)},
      {"box", box({-4.2, -5.1, -3.3}, {3.9, 5, 4.4})}, {"octahedron", octahedron({0, 0, 0}, 8.7)}};
  return all;
}

// No node is left out: both are right but within rounding of the surface, 1e-14, where of some 10^5 nodes at
// random places none is.
TEST(InsideShapes, AreMarkedAsSolidAnglesTell) {
  const Grid grid = {{21, 22, 23}, {false, false, false}};
  unsigned seed = 1;
  for (const Shape& shape : shapes()) {
    std::int64_t n_inside = 0;
    for (int place = 0; place < 4; ++place) {
      const std::vector<Surface> surfaces = {
          placed_at_random(shape.surface, {10, 10.5, 11}, {11, 11.5, 12}, ++seed)};
      const Marks marks = marks_of(grid, surfaces);
      EXPECT_EQ(marks, marks_by_solid_angles(grid, surfaces)) << shape.name << ", place " << place;
      n_inside += number_inside(marks);
    }
    EXPECT_GT(n_inside, 4) << shape.name;
  }
}

TEST(InsideShapes, AreMarkedAcrossPeriodicFacesEdgesAndCorners) {
  const Grid grid = {{19, 20, 21}, {true, true, true}};
  unsigned seed = 100;
  for (const Vector& centre : {Vector{0, 10, 11}, Vector{9, 20, 11}, Vector{9, 10, 0}, Vector{19, 0, 11},
                               Vector{9, 20, 21}, Vector{0, 10, 21}, Vector{0, 0, 0}, Vector{19, 20, 21}}) {
    ++seed;  // so that each place has the shapes that the last one had not
    for (const Shape& shape : shapes()) {
      if (++seed % 2 == 0) continue;  // half of them, which takes half as long
      const std::vector<Surface> surfaces = {placed_at_random(shape.surface, centre, centre, seed)};
      EXPECT_EQ(marks_of(grid, surfaces), marks_by_solid_angles(grid, surfaces)) << shape.name << " " << seed;
    }
  }
}

TEST(InsideShapes, AreMarkedAlikeFarFromTheBox) {
  // Coordinates are multiples of 2^-20, and so exact after any number of periods; or of 1/2, so that many
  // nodes are on faces, where the last bit decides.
  const Grid grid = {{19, 20, 21}, {true, true, true}};
  unsigned seed = 200;
  for (const double unit : {0x1p-20, 0.5}) {
    for (const Shape& shape : {shapes()[0], shapes()[2], shapes()[5]}) {
      Surface surface = placed_at_random(shape.surface, {8.5, 9, 9.5}, {10.5, 11, 11.5}, ++seed);
      for (double& number : surface.positions) number = unit * std::round(number / unit);
      const Marks marks = marks_of(grid, {surface});
      for (const double periods : {-3.0, 7.0, -1e6, 2e7}) {
        const Surface far = moved(surface, {19 * periods, -20 * periods, 21 * periods});
        EXPECT_EQ(marks_of(grid, {far}), marks) << shape.name << ", " << periods << " periods";
      }
    }
  }
}

TEST(InsideShapes, AreMarkedWithTheirNumbers) {
  const Grid grid = {{32, 33, 34}, {true, true, false}};
  // A ball in the bowl, a plate beside it, a needle across the faces of x and y.
  const std::vector<Surface> surfaces = {
      placed(stomatocyte(3, 7.3, 1.9), {1, 2, 3}, 1.1, {16.2, 16.1, 16.4}),
      placed(ellipsoid(2, {4.1, 3.7, 3.3}), {3, 1, 2}, 0.3, {16.2, 16.1, 16.4}),
      placed(ellipsoid(2, {9.3, 8.1, 1.2}), {0, 0, 1}, 0.4, {15.7, 17.2, 28.9}),
      placed(ellipsoid(2, {0.9, 0.8, 8.4}), {1, -1, 0}, 1.5, {0.3, -0.2, 4.1})};
  const Marks marks = marks_of(grid, surfaces);
  EXPECT_EQ(marks, marks_by_solid_angles(grid, surfaces));
  for (int mark = 1; mark <= 4; ++mark) EXPECT_GT(std::ranges::count(marks, mark), 20) << mark;
}

TEST(InsideShapes, MayGoThroughWalls) {
  const Grid grid = {{12, 13, 14}, {false, false, false}};
  for (const Vector& centre : {Vector{0, 6, 7}, Vector{12, 6, 7}, Vector{6, 0, 7}, Vector{6, 13, 7},
                               Vector{6, 6, 0}, Vector{6, 6, 14}, Vector{-20, 6, 7}, Vector{6, 40, 7},
                               Vector{6, 6, -30}, Vector{0, 0, 0}, Vector{12, 13, 14}}) {
    const std::vector<Surface> surfaces = {placed(ellipsoid(2, {3.1, 4.2, 5.3}), {1, 2, 3}, 0.7, centre)};
    EXPECT_EQ(marks_of(grid, surfaces), marks_by_solid_angles(grid, surfaces)) << centre[0];
  }
}

}  // namespace
}  // namespace tanktread::coupler
