// Nodes on faces, edges and corners, rows along them, and surfaces that share triangles: each node has one
// side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/coupler_closed_surfaces.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

/// 1 where holds(node position), else 0.
template <class Holds>
Marks marks_where(const Grid& grid, const Holds& holds) {
  Marks marks(std::size_t{1} * grid.nodes[0] * grid.nodes[1] * grid.nodes[2]);
  for (std::size_t node = 0; node < marks.size(); ++node)
    marks[node] = holds(position_of(grid, static_cast<std::int64_t>(node))) ? 1 : 0;
  return marks;
}

TEST(InsideTies, FacesAtLesserCoordinatesAreInsideThoseAtGreaterOnesOutside) {
  const Grid grid = {{11, 12, 13}, {true, false, true}};
  for (const double shift : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Vector least = {1.5 + shift, 2.5, 3.5 - shift}, greatest = {5.5, 8.5 + shift, 10.5};
    EXPECT_EQ(marks_of(grid, {box(least, greatest)}),
              marks_where(grid,
                          [&](const Vector& node) {
                            bool inside = true;
                            for (int axis = 0; axis < 3; ++axis)
                              inside = inside && least[axis] <= node[axis] && node[axis] < greatest[axis];
                            return inside;
                          }))
        << shift;
  }
}

TEST(InsideTies, ABoxFillsAPeriodExactly) {
  const Grid grid = {{6, 7, 8}, {true, true, true}};
  for (const double shift : {0.0, 0.5, 2.25, -3.5}) {
    const Marks marks = marks_of(grid, {moved(box({0, 0, 0}, {6, 7, 8}), {shift, 2 * shift, -shift})});
    EXPECT_EQ(number_inside(marks), 6 * 7 * 8) << shift;
  }
}

// All corners are nodes, all edges and faces go through nodes, and rows along x go through corners and edges.
// On the surface it is x that decides, and the lesser x is inside.
TEST(InsideTies, OfAnOctahedronOnTheNodes) {
  const Grid grid = {{25, 25, 25}, {false, false, false}};
  const Vector centre = {12.5, 12.5, 12.5};
  for (int radius = 1; radius <= 11; ++radius) {
    const Marks expected = marks_where(grid, [&](const Vector& node) {
      const double distance = std::abs(node[0] - 12.5) + std::abs(node[1] - 12.5) + std::abs(node[2] - 12.5);
      return distance < radius || (distance == radius && node[0] < 12.5);
    });
    EXPECT_EQ(marks_of(grid, {octahedron(centre, radius)}), expected) << radius;
  }
}

/// Cells of 4 x 4 x 4 that fill a cube of 12, cut in six tetrahedra around the diagonal each, whose corners
/// are moved off the lattice.
/// @param period of the corners, perhaps the cube's; else corners on its faces stay on them
template <class Offset>
std::vector<Surface> tetrahedra(bool periodic, const Offset& offset) {
  constexpr int n = 3, size = 4;
  const auto corner = [&](std::array<int, 3> place) {
    const std::array<int, 3> of = {place[0] % n, place[1] % n, place[2] % n};
    Vector position;
    for (int axis = 0; axis < 3; ++axis) {
      const bool on_face = !periodic && place[axis] % n == 0;
      position[axis] = size * place[axis] + (on_face ? 0 : offset(of, axis));
    }
    return position;
  };
  std::vector<Surface> surfaces;
  for (int cell = 0; cell < n * n * n; ++cell) {
    std::array<int, 3> path = {0, 1, 2};
    do {
      std::array<int, 3> place = {cell % n, cell / n % n, cell / (n * n)};
      std::array<Vector, 4> corners;
      corners[0] = corner(place);
      for (int step = 0; step < 3; ++step) {
        ++place[path[step]];
        corners[step + 1] = corner(place);
      }
      // Neighbours shall not number the corners that they share in the same order.
      std::rotate(corners.begin(), corners.begin() + surfaces.size() % 4, corners.end());
      surfaces.push_back(tetrahedron(corners));
    } while (std::ranges::next_permutation(path).found);
  }
  return surfaces;
}

/// Numbers from 0 to 1 for corners of the lattice, the same in every run.
struct Random {
  explicit Random(unsigned seed) : numbers(random_numbers(81, 0, 1, seed)) {}
  double operator()(const std::array<int, 3>& place, int axis) const {
    return numbers[3 * (9 * place[2] + 3 * place[1] + place[0]) + axis];
  }
  Numbers numbers;
};

TEST(InsideTies, TetrahedraThatFillACubeShareItsNodes) {
  const Grid grid = {{12, 12, 12}, {false, false, false}};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    // Corners on nodes, on faces and edges between cells of the grid, or anywhere.
    for (const double unit : {0.5, 0.25, 1e-3}) {
      const Random random(seed);
      const auto surfaces = tetrahedra(false, [&](const auto& place, int axis) {
        return unit * std::round((random(place, axis) - 0.5) / unit);
      });
      ASSERT_EQ(surfaces.size(), 162U);
      // No node is in two of them: that would be refused.
      EXPECT_EQ(number_inside(marks_of(grid, surfaces)), 12 * 12 * 12) << seed << " " << unit;
    }
  }
}

TEST(InsideTies, TetrahedraThatFillAPeriodShareItsNodes) {
  const Grid grid = {{12, 12, 12}, {true, true, true}};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Random random(seed);
    // Multiples of 2^-20, so that images are exact; no face goes through a node then but by chance.
    const auto surfaces = tetrahedra(true, [&](const auto& place, int axis) {
      return std::round(random(place, axis) * 0x1p20) * 0x1p-20;
    });
    EXPECT_EQ(number_inside(marks_of(grid, surfaces)), 12 * 12 * 12) << seed;
  }
}

/// `inner` within `outer`: the space between them.
Surface shell(const Surface& outer, const Surface& inner) {
  Surface both = outer;
  const int n_nodes = static_cast<int>(outer.positions.size() / 3);
  both.positions.insert(both.positions.end(), inner.positions.begin(), inner.positions.end());
  for (const int node : turned_over(inner).triangles) both.triangles.push_back(n_nodes + node);
  return both;
}

TEST(InsideTies, ABallAndTheShellAroundItShareTheNodes) {
  const Grid grid = {{24, 24, 24}, {false, false, false}};
  for (const double unit : {0.5, 0.25, 0x1p-30}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Surface ball = placed_at_random(ellipsoid(2, {6.5, 7.5, 8.5}), {11, 11, 11}, {13, 13, 13}, seed);
      for (double& number : ball.positions) number = unit * std::round(number / unit);
      const Surface cube = box({0.5, 0.5, 0.5}, {23.5, 23.5, 23.5});
      const Marks marks = marks_of(grid, {ball, shell(cube, ball)});
      EXPECT_EQ(number_inside(marks), 23 * 23 * 23);
      const Marks alone = marks_of(grid, {ball});
      for (std::size_t node = 0; node < marks.size(); ++node) EXPECT_EQ(marks[node] == 1, alone[node] == 1);
    }
  }
}

/// A box with cells x cells squares on each side, of two triangles each.
Surface refined_box(const Vector& least, const Vector& greatest, int cells) {
  Surface surface;
  const auto node_at = [&](const std::array<int, 3>& place) {
    Vector position;
    for (int axis = 0; axis < 3; ++axis)
      position[axis] = least[axis] + (greatest[axis] - least[axis]) * place[axis] / cells;
    for (std::size_t node = 0; node < surface.positions.size() / 3; ++node) {
      if (std::equal(position.begin(), position.end(), &surface.positions[3 * node]))
        return static_cast<int>(node);
    }
    surface.positions.insert(surface.positions.end(), position.begin(), position.end());
    return static_cast<int>(surface.positions.size() / 3) - 1;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, cells}) {
      for (int square = 0; square < cells * cells; ++square) {
        std::array<int, 4> corners;
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> place;
          place[axis] = side;
          place[(axis + 1) % 3] = square % cells + (k == 1 || k == 2 ? 1 : 0);
          place[(axis + 2) % 3] = square / cells + (k >= 2 ? 1 : 0);
          corners[k] = node_at(place);
        }
        if (side == 0) std::swap(corners[1], corners[3]);
        surface.triangles.insert(surface.triangles.end(),
                                 {corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]});
      }
    }
  }
  return surface;
}

/// Coordinates changed by up to three roundings.
Surface rounded_otherwise(Surface surface, unsigned seed) {
  const Numbers random = random_numbers(surface.positions.size(), -3, 3, seed);
  for (std::size_t k = 0; k < random.size(); ++k) surface.positions[k] *= 1 + eps * std::round(random[k]);
  return surface;
}

// Faces along rows, planes of rows and nodes, off them by a few roundings of their corners each: a row may be
// in or out of such a face, but it ends there, and it does not reach a node that is beside it.
TEST(InsideTies, FacesWithinRoundingOfRowsDoNotLeak) {
  const Grid grid = {{12, 13, 14}, {false, false, false}};
  for (unsigned seed = 1; seed <= 200; ++seed) {
    for (const int cells : {1, 2, 5}) {
      const Surface surface = rounded_otherwise(refined_box({2.5, 3.5, 4.5}, {7.5, 8.5, 9.5}, cells), seed);
      const Marks marks = marks_of(grid, {surface});
      for (std::size_t node = 0; node < marks.size(); ++node) {
        const Vector at = position_of(grid, static_cast<std::int64_t>(node));
        const bool inside = at[0] > 3 && at[0] < 7 && at[1] > 4 && at[1] < 8 && at[2] > 5 && at[2] < 9;
        const bool outside = at[0] < 2 || at[0] > 8 || at[1] < 3 || at[1] > 9 || at[2] < 4 || at[2] > 10;
        if (!inside && !outside) continue;
        ASSERT_EQ(marks[node], inside ? 1 : 0) << seed;
      }
    }
  }
}

TEST(InsideTies, RowsWithinRoundingOfNodesAndEdgesDoNotLeak) {
  const Grid grid = {{24, 24, 24}, {false, false, false}};
  std::int64_t on_surface = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Numbers random = random_numbers(3, 11, 13, seed);
    const Vector centre = {random[0], random[1], random[2]};
    const auto ball = [&](double factor) {
      Surface surface = placed(ellipsoid(3, {6.5, 7.5, 8.5}), {1, 2, 3}, seed, centre);
      for (std::size_t k = 0; k < surface.positions.size(); ++k) {
        const double node = 0.5 * std::round(2 * surface.positions[k]);
        surface.positions[k] = centre[k % 3] + factor * (node - centre[k % 3]);
      }
      return surface;
    };
    // All nodes of the surface are on nodes of the grid or between two, and many triangles are flat.
    const Marks marks = marks_of(grid, {rounded_otherwise(ball(1), seed)}),
                smaller = marks_of(grid, {ball(1 - 1e-9)}), larger = marks_of(grid, {ball(1 + 1e-9)});
    for (std::size_t node = 0; node < marks.size(); ++node) {
      ASSERT_GE(marks[node], smaller[node]) << seed;
      ASSERT_LE(marks[node], larger[node]) << seed;
    }
    on_surface += number_inside(larger) - number_inside(smaller);
  }
  EXPECT_GT(on_surface, 10000);
}

// Near a tip at a node a row is inside for a length that is less than the roundings of where it goes in and
// out, which in one case of 5000 have the node between them, in the wrong order. That is not refused.
TEST(InsideTies, TipsWithinRoundingOfNodesAreNoOverlap) {
  const Grid grid = {{12, 12, 12}, {false, false, false}};
  for (unsigned seed = 1; seed <= 40000; ++seed) {
    const Numbers random = random_numbers(9, 1, 11, seed);
    const std::vector<Surface> surfaces = {rounded_otherwise(
        tetrahedron({Vector{5.5, 6.5, 4.5}, Vector{random[0], random[1], random[2]},
                     Vector{random[3], random[4], random[5]}, Vector{random[6], random[7], random[8]}}),
        seed)};
    Marks marks;
    ASSERT_NO_THROW(marks = marks_of(grid, surfaces)) << seed;
    if (seed % 20 != 0) continue;
    Marks expected = marks_by_solid_angles(grid, surfaces);
    const int tip = 5 + 12 * (6 + 12 * 4);
    marks[tip] = expected[tip] = 0;
    ASSERT_EQ(marks, expected) << seed;
  }
}

}  // namespace
}  // namespace tanktread::coupler
