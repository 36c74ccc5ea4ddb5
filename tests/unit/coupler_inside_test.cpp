// Marks of surfaces that move: update() against mark(), the changes, any number of threads.
#include "coupler/inside.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "tests/unit/coupler_closed_surfaces.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

constexpr Grid grid = {{24, 25, 26}, {true, true, false}};

/// Three surfaces that turn, swell, bend and go round the box, by less than half a grid step a time.
std::vector<Surface> surfaces_at(int time) {
  const double t = time;
  const double swelling = 1 + 0.05 * std::sin(0.4 * t);
  std::vector<Surface> surfaces = {
      placed(ellipsoid(2, {4.1 * swelling, 3.3 / swelling, 3.9}), {1, 2, 3}, 0.03 * t,
             {12.1 + 0.3 * t, 11.3, 6.2}),
      placed(stomatocyte(3, 4.7, 1.4), {2, -1, 1}, 0.5 + 0.04 * t, {3.9 - 0.2 * t, 12.5 + 0.3 * t, 18.5}),
      placed(biconcave_disc(2, 4.4), {0, 0, 1}, 0.02 * t, {14.2 - 0.2 * t, 24.1, 18.6})};
  for (std::size_t k = 0; k < surfaces[2].positions.size(); k += 3)
    surfaces[2].positions[k + 2] += 0.4 * std::sin(0.3 * t) * std::cos(0.5 * surfaces[2].positions[k]);
  // The bowl goes along y and would meet the disc.
  surfaces.resize(time < 12 ? 3 : 1);
  return surfaces;
}

void expect_replay(const Marks& before, const InsideMarks& inside) {
  Marks marks = before;
  std::int64_t last = -1;
  for (const auto& change : inside.changes()) {
    ASSERT_GT(change.node, last);
    ASSERT_LT(change.node, static_cast<std::int64_t>(marks.size()));
    ASSERT_EQ(change.before, marks[change.node]);
    ASSERT_NE(change.before, change.now);
    marks[change.node] = change.now;
    last = change.node;
  }
  EXPECT_TRUE(std::ranges::equal(marks, inside.marks()));
}

Marks copy_of(std::span<const std::int32_t> marks) {
  return {marks.begin(), marks.end()};
}

TEST(InsideMarks, AreAllOutsideAtFirst) {
  const InsideMarks inside(grid);
  EXPECT_EQ(inside.marks().size(), 24U * 25U * 26U);
  EXPECT_EQ(number_inside(copy_of(inside.marks())), 0);
  EXPECT_TRUE(inside.changes().empty());
}

TEST(InsideMarks, UpdatesAreAsIfMarkedAnew) {
  InsideMarks updated(grid, 1), marked(grid, 1);
  std::size_t most_changes = 0;
  for (int time = 0; time < 60; ++time) {
    const auto surfaces = surfaces_at(time);
    const Spans spans(surfaces);
    const Marks before = copy_of(updated.marks());
    updated.update(spans.positions, spans.triangles);
    marked.mark(spans.positions, spans.triangles);
    const Marks expected = marks_of(grid, surfaces);
    EXPECT_EQ(copy_of(updated.marks()), expected) << time;
    EXPECT_EQ(copy_of(marked.marks()), expected) << time;
    expect_replay(before, updated);
    expect_replay(before, marked);
    if (time > 0 && time < 12) most_changes = std::max(most_changes, updated.changes().size());
  }
  // A small part of the nodes that are inside, some 500.
  EXPECT_GT(most_changes, 10U);
  EXPECT_LT(most_changes, 250U);
}

TEST(InsideMarks, NothingChangesWhereNothingMoves) {
  InsideMarks inside(grid, 2);
  const auto surfaces = surfaces_at(3);
  const Spans spans(surfaces);
  inside.mark(spans.positions, spans.triangles);
  EXPECT_EQ(static_cast<std::int64_t>(inside.changes().size()), number_inside(copy_of(inside.marks())));
  const std::int32_t* place = inside.marks().data();
  inside.update(spans.positions, spans.triangles);
  EXPECT_TRUE(inside.changes().empty());
  inside.mark(spans.positions, spans.triangles);
  EXPECT_TRUE(inside.changes().empty());
  EXPECT_EQ(inside.marks().data(), place);
}

TEST(InsideMarks, SurfacesMayJumpComeGoAndChangeTheirOrder) {
  InsideMarks inside(grid, 3);
  std::vector<std::vector<Surface>> lists = {
      surfaces_at(0), {}, surfaces_at(5), surfaces_at(50), surfaces_at(1)};
  lists.push_back(lists.back());
  std::ranges::reverse(lists.back());
  lists.push_back({lists.back()[1]});
  lists.push_back({Surface{}, lists.back()[0]});
  for (const auto& surfaces : lists) {
    const Spans spans(surfaces);
    const Marks before = copy_of(inside.marks());
    inside.update(spans.positions, spans.triangles);
    EXPECT_EQ(copy_of(inside.marks()), marks_of(grid, surfaces));
    expect_replay(before, inside);
  }
}

TEST(InsideMarks, DoNotDependOnTheNumberOfThreads) {
  std::deque<InsideMarks> all;
  for (const int threads : {1, 2, 3, 4, 7}) all.emplace_back(grid, threads);
  for (int time = 0; time < 16; ++time) {
    const auto surfaces = surfaces_at(time);
    const Spans spans(surfaces);
    for (InsideMarks& inside : all) inside.update(spans.positions, spans.triangles);
    for (const InsideMarks& inside : all) {
      EXPECT_TRUE(std::ranges::equal(inside.marks(), all[0].marks()));
      EXPECT_TRUE(std::ranges::equal(inside.changes(), all[0].changes(), [](const auto& a, const auto& b) {
        return a.node == b.node && a.before == b.before && a.now == b.now;
      }));
    }
  }
}

TEST(InsideMarks, CountTheVolume) {
  const double radius = 7.3;
  const Surface sphere = ellipsoid(3, {radius, radius, radius});
  double volume = 0;
  for (std::size_t t = 0; t < sphere.triangles.size(); t += 3) {
    const double *a = &sphere.positions[3 * sphere.triangles[t]],
                 *b = &sphere.positions[3 * sphere.triangles[t + 1]],
                 *c = &sphere.positions[3 * sphere.triangles[t + 2]];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0])) /
              6;
  }
  std::int64_t count = 0;
  for (int shift = 0; shift < 512; ++shift) {
    const Vector centre = {12 + shift % 8 / 8.0, 12 + shift / 8 % 8 / 8.0, 12 + shift / 64 / 8.0};
    count += number_inside(marks_of(grid, {moved(sphere, centre)}));
  }
  // All the shifts together are one lattice, in which the radius is R = 8 x 7.3 steps. By chance the nodes
  // near its surface would make an error of the root of their number, (4 pi R^2)^(1/2)/(4 pi R^3/3) = 2.5e-4.
  EXPECT_NEAR(static_cast<double>(count) / 512 / volume, 1, 5e-4);
}

}  // namespace
}  // namespace tanktread::coupler
