// Normals of the nodes: how they weigh triangles, and that of many surfaces they are those of one.
#include "coupler/node_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

TEST(NodeNormals, WeighTheTrianglesAroundByTheirEdges) {
  // A square of two triangles in the plane z = 0, and an upright triangle on one side of it.
  const Numbers positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, -1};
  const std::vector<int> triangles = {0, 1, 2, 0, 2, 3, 0, 4, 1};
  Numbers normals(15, std::nan(""));
  node_normals(positions, triangles, normals);
  // At nodes 0 and 1 the flat part has the weights 1/2 + 1/2 and 1, the upright one, whose edges there are of
  // length 1 and of the square 5/4, 4/5.
  const double length = std::sqrt(1 + 0.8 * 0.8);
  const Numbers expected = joined(
      {{0, -0.8 / length, 1 / length}, {0, -0.8 / length, 1 / length}, {0, 0, 1}, {0, 0, 1}, {0, -1, 0}});
  for (std::size_t k = 0; k < 15; ++k) EXPECT_NEAR(normals[k], expected[k], 2 * eps) << k;
}

TEST(NodeNormals, AreExactOnASphereHoweverUnevenTheTriangles) {
  // A fan of six around a node; the numbers are of no importance.
  const double latitude[] = {0.3, 0.5, 0.2, 0.9, 0.4, 0.6}, longitude[] = {0.1, 0.9, 2.2, 3.0, 4.4, 5.5};
  const double radius = 3, centre[] = {0.5, -1, 2};
  Numbers positions = {centre[0], centre[1], centre[2] + radius};
  std::vector<int> triangles;
  for (int k = 0; k < 6; ++k) {
    positions.push_back(centre[0] + radius * std::sin(latitude[k]) * std::cos(longitude[k]));
    positions.push_back(centre[1] + radius * std::sin(latitude[k]) * std::sin(longitude[k]));
    positions.push_back(centre[2] + radius * std::cos(latitude[k]));
    triangles.insert(triangles.end(), {0, k + 1, (k + 1) % 6 + 1});
  }
  Numbers normals(positions.size());
  node_normals(positions, triangles, normals);
  // Edges of a fifth of the radius and more lose so many times their own rounding, and their products twice
  // that.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(normals[axis], axis == 2 ? 1 : 0, 50 * eps) << axis;
}

TEST(NodeNormals, RefuseWhatIsNoSurface) {
  const Numbers positions = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  Numbers normals(9), too_few(6);
  EXPECT_THROW(node_normals(positions, std::vector<int>{0, 1, 3}, normals), std::invalid_argument);
  EXPECT_THROW(node_normals(positions, std::vector<int>{0, 1, -1}, normals), std::invalid_argument);
  EXPECT_THROW(node_normals(positions, std::vector<int>{0, 1}, normals), std::invalid_argument);
  EXPECT_THROW(node_normals(positions, std::vector<int>{0, 1, 2}, too_few), std::invalid_argument);
}

/// Nodes at random, and triangles that each node is a corner of many of.
struct Heap {
  Heap(int n_nodes, unsigned seed) : positions(random_numbers(3 * n_nodes, -1, 1, seed)) {
    for (int k = 0; k < 5 * n_nodes; ++k) {
      for (const int step : {0, 1 + k % 7, 9 + k % 5}) triangles.push_back((k + step) % n_nodes);
    }
  }
  Numbers positions;
  std::vector<int> triangles;
};

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

TEST(NodeNormals, OfManySurfacesAreThoseOfEachForAnyNumberOfThreads) {
  std::vector<Heap> heaps = {{40, 1}, {23, 2}, {100, 3}};
  NodeNormals one(1), two(2), many(64);
  // The second time positions are others, the third time the triangles of one surface are, the fourth time
  // all is as before.
  for (int time = 0; time < 4; ++time) {
    std::vector<std::span<const double>> positions;
    std::vector<std::span<const int>> triangles;
    for (const auto& heap : heaps) {
      positions.emplace_back(heap.positions);
      triangles.emplace_back(heap.triangles);
    }
    for (auto* normals : {&one, &two, &many}) {
      const auto found = normals->find(positions, triangles);
      ASSERT_EQ(found.size(), heaps.size());
      for (std::size_t k = 0; k < heaps.size(); ++k) {
        Numbers expected(positions[k].size());
        node_normals(positions[k], triangles[k], expected);
        EXPECT_TRUE(same_bits(found[k], expected)) << "surface " << k << ", time " << time;
      }
    }
    if (time == 0) heaps[1].positions = random_numbers(heaps[1].positions.size(), -1, 1, 4);
    if (time == 1) std::swap(heaps[2].triangles[5], heaps[2].triangles[90]);
  }
}

// On a part of a grid a surface that is far away has no nodes.
TEST(NodeNormals, OfSurfacesThatComeAndGo) {
  const Numbers positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, -1};
  const std::vector<int> triangles = {0, 1, 2, 0, 2, 3, 0, 4, 1};
  Numbers expected(15);
  node_normals(positions, triangles, expected);
  NodeNormals normals(1);
  for (const int which : {1, 0, 3, 0, 0, 2, 1}) {  // bits: which of the two surfaces are there
    std::vector<std::span<const double>> points(2);
    std::vector<std::span<const int>> corners(2);
    for (std::size_t s = 0; s < 2; ++s) {
      if ((which >> s & 1) == 0) continue;
      points[s] = positions;
      corners[s] = triangles;
    }
    const auto found = normals.find(points, corners);
    ASSERT_EQ(found.size(), 2);
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_EQ(Numbers(found[s].begin(), found[s].end()), points[s].empty() ? Numbers() : expected) << which;
  }
}

TEST(NodeNormals, RefuseOtherNumbersOfSurfaces) {
  const Heap heap(20, 6);
  const std::span<const double> positions(heap.positions);
  EXPECT_THROW(NodeNormals(1).find({&positions, 1}, {}), std::invalid_argument);
  EXPECT_THROW(NodeNormals(-1), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::coupler
