// What is refused: with the surface, the place, and the old marks left as they were.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/coupler_closed_surfaces.hpp"

namespace tanktread::coupler::inside_refusal_test {
namespace {

using namespace test;

constexpr Grid grid = {{12, 13, 14}, {true, true, false}};

/// What marking says, for each of these numbers of threads; empty: nothing.
std::string refusal(const std::vector<Surface>& surfaces,
                    const std::vector<int>& numbers_of_threads = {1, 2, 3, 4}) {
  std::string message;
  for (const int threads : numbers_of_threads) {
    InsideMarks inside(grid, threads);
    const std::vector<Surface> first = {box({1, 1, 1}, {4, 4, 4})};
    const Spans before(first), spans(surfaces);
    inside.mark(before.positions, before.triangles);
    std::string refused;
    for (const bool anew : {false, true}) {
      try {
        anew ? inside.mark(spans.positions, spans.triangles)
             : inside.update(spans.positions, spans.triangles);
        return "";
      } catch (const InsideError& error) {
        refused = error.what();
      }
      EXPECT_TRUE(threads == 1 && !anew ? message.empty() : refused == message) << refused;
      message = refused;
    }
    EXPECT_EQ(number_inside({inside.marks().begin(), inside.marks().end()}), 27);
    EXPECT_EQ(inside.changes().size(), 27U);
    // It goes on from there.
    inside.update({}, {});
    EXPECT_EQ(inside.changes().size(), 27U);
  }
  return message;
}

TEST(InsideRefusal, SurfacesThatOverlap) {
  EXPECT_EQ(refusal({box({1, 1, 1}, {3, 3, 3}), box({4, 4, 4}, {7, 7, 7}), box({6, 6, 6}, {9, 9, 9})}),
            "coupler: surface 1 and surface 2 overlap at grid node (6, 6, 6)");
  // One within the other, the same twice, across the face of x, y.
  EXPECT_EQ(refusal({box({5, 5, 5}, {7, 7, 7}), box({4, 4, 4}, {9, 9, 9})}),
            "coupler: surface 0 and surface 1 overlap at grid node (5, 5, 5)");
  EXPECT_EQ(refusal({box({4, 4, 4}, {9, 9, 9}), box({4, 4, 4}, {9, 9, 9})}),
            "coupler: surface 0 and surface 1 overlap at grid node (4, 4, 4)");
  EXPECT_EQ(refusal({box({1, 1, 4}, {3, 3, 6}), box({10, 11, 5}, {14, 15, 8})}),
            "coupler: surface 0 and surface 1 overlap at grid node (1, 1, 5)");
  // No node is in both: [5.6, 6.4] is between them.
  EXPECT_EQ(refusal({box({4, 4, 4}, {6.4, 7, 7}), box({5.6, 4, 4}, {9, 7, 7})}), "");
}

/// Two surfaces as one.
Surface joined_surfaces(Surface first, const Surface& second) {
  const int n_nodes = static_cast<int>(first.positions.size() / 3);
  first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
  for (const int node : second.triangles) first.triangles.push_back(n_nodes + node);
  return first;
}

TEST(InsideRefusal, ASurfaceThatOverlapsItself) {
  EXPECT_EQ(refusal({joined_surfaces(box({4, 4, 4}, {7, 7, 7}), box({6, 6, 6}, {9, 9, 9}))}),
            "coupler: surface 0 overlaps itself at grid node (6, 6, 6)");
  // However short; but not by rounding, nor between nodes.
  EXPECT_EQ(
      refusal({joined_surfaces(box({4, 4, 4}, {6.5 + 1e-8, 7, 7}), box({6.5 - 1e-8, 4, 4}, {9, 7, 7}))}),
      "coupler: surface 0 overlaps itself at grid node (6, 4, 4)");
  for (const double end : {6.5 + 1e-13, 7.4})
    EXPECT_EQ(refusal({joined_surfaces(box({4, 4, 4}, {end, 7, 7}), box({6.5 + 1e-14, 4, 4}, {9, 7, 7}))}),
              "");
  // Longer than the period, or two.
  EXPECT_EQ(refusal({Surface{}, box({2, 4, 4}, {16, 6, 6})}),
            "coupler: surface 1 overlaps its periodic image at grid node (2, 4, 4)");
  EXPECT_EQ(refusal({box({2, 4, 4}, {4, 18, 6})}),
            "coupler: surface 0 overlaps its periodic image at grid node (2, 4, 4)");
  EXPECT_EQ(refusal({box({2, 4, 4}, {4, 6, 6}), box({2, 7, 4}, {4, 34, 6})}),
            "coupler: surface 1 spreads over 27 along y, at most two periods of 13 are allowed");
}

TEST(InsideRefusal, ASurfaceWithItsInsideOut) {
  EXPECT_EQ(refusal({box({1, 1, 1}, {3, 3, 3}), turned_over(box({4, 5, 6}, {9, 9, 9}))}),
            "coupler: surface 1 has its inside out at grid node (4, 5, 6)");
  EXPECT_NE(refusal({turned_over(moved(stomatocyte(3, 4, 2), {6, 6, 6}))}), "");
}

TEST(InsideRefusal, ASurfaceThatIsNotClosed) {
  Surface open = box({4, 5, 6}, {9, 9, 9});
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 3);  // half of that at the least x
  // The hole has its corners at y, z = 5, 6 and 5, 9 and 9, 9: the first row through it is y, z = 5.5, 6.5,
  // which meets the face at the greatest x only.
  EXPECT_EQ(
      refusal({box({1, 1, 1}, {3, 3, 3}), open}),
      "coupler: surface 1 is not closed: the row along x goes through a hole. It first meets the surface "
      "at grid node (9, 5, 6)");
  // A hole at any triangle of a sphere that rows go through.
  const Surface sphere = placed(ellipsoid(1, {4.1, 4.2, 4.3}), {1, 2, 3}, 0.3, {11.2, 6.1, 7.4});
  int n_seen = 0;
  for (std::size_t t = 0; t < sphere.triangles.size(); t += 3) {
    Surface holed = sphere;
    holed.triangles.erase(holed.triangles.begin() + t, holed.triangles.begin() + t + 3);
    const std::string message = refusal({holed}, {1});
    EXPECT_TRUE(message.empty() || message.find("surface 0 is not closed") != std::string::npos) << message;
    n_seen += message.empty() ? 0 : 1;
  }
  // Triangles of 2.7 grid steps squared, on the average; a few are seen from their edges.
  EXPECT_GT(n_seen, 60);
  // One turned over is as bad.
  Surface twisted = box({4, 5, 6}, {9, 9, 9});
  std::swap(twisted.triangles[0], twisted.triangles[1]);
  EXPECT_NE(refusal({twisted}), "");
}

TEST(InsideRefusal, PositionsThatAreNoPlace) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.1e9, 1e300}) {
    Surface surface = box({4, 5, 6}, {9, 9, 9});
    surface.positions[3 * 5 + 1] = bad;
    const std::string message = refusal({box({1, 1, 1}, {3, 3, 3}), surface});
    EXPECT_EQ(message.substr(0, 32), "coupler: surface 1, node 5: y = ") << message;
  }
}

TEST(InsideRefusal, SizesThatDoNotFit) {
  InsideMarks inside(grid, 2);
  const Surface surface = box({4, 5, 6}, {9, 9, 9});
  const std::span<const double> positions(surface.positions);
  const std::span<const int> triangles(surface.triangles);
  const auto mark = [&](std::span<const double> some_positions, std::span<const int> some_triangles) {
    inside.mark({&some_positions, 1}, {&some_triangles, 1});
  };
  EXPECT_THROW(mark(positions.first(23), triangles), std::invalid_argument);
  EXPECT_THROW(mark(positions.first(21), triangles), std::invalid_argument);
  EXPECT_THROW(mark(positions, triangles.first(35)), std::invalid_argument);
  const std::vector<int> negative = {0, 1, -1};
  EXPECT_THROW(mark(positions, negative), std::invalid_argument);
  EXPECT_THROW(inside.mark({&positions, 1}, {}), std::invalid_argument);
  EXPECT_THROW(inside.update({}, {&triangles, 1}), std::invalid_argument);
  EXPECT_THROW(InsideMarks(grid, -1), std::invalid_argument);
  EXPECT_THROW(InsideMarks(Grid{{12, 0, 14}, {true, true, true}}), std::invalid_argument);
  EXPECT_TRUE(inside.changes().empty());
  mark(positions, triangles);
  EXPECT_EQ(number_inside({inside.marks().begin(), inside.marks().end()}), 5 * 4 * 3);
}

}  // namespace
}  // namespace tanktread::coupler::inside_refusal_test
