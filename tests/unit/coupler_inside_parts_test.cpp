// What is inside surfaces at the nodes of a part of a grid is what it is in the whole, wherever it is cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>

#include "tests/unit/coupler_closed_surfaces.hpp"
#include "tests/unit/coupler_parts.hpp"

namespace tanktread::coupler::inside_parts_test {
namespace {

using namespace test;

constexpr std::array<int, 3> nodes_of_box = {24, 20, 18};

using Changes = std::vector<InsideMarks::Change>;

/// The marks of all parts of a grid, put together.
class Parts {
 public:
  Parts(const Grid& grid, const std::array<int, 3>& division, int threads)
      : grid_(grid), parts_(parts_of(grid, division)) {
    for (const GridPart& part : parts_) inside_.push_back(std::make_unique<InsideMarks>(grid, part, threads));
  }

  /// @return the message of the error with the lowest precedence; empty: there is none
  std::string take_in(const std::vector<Surface>& surfaces, bool anew) {
    const Spans spans(surfaces);
    std::optional<InsideError> first;
    for (const auto& inside : inside_) {
      try {
        anew ? inside->mark(spans.positions, spans.triangles)
             : inside->update(spans.positions, spans.triangles);
      } catch (const InsideError& error) {
        if (!first || error.precedence < first->precedence) first.emplace(error);
      }
    }
    return first ? first->what() : "";
  }

  Marks marks() const {
    Marks all(count_of(grid_.nodes), -1);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto marks = inside_[k]->marks();
      EXPECT_EQ(static_cast<std::int64_t>(marks.size()), count_of(parts_[k].nodes));
      for (std::size_t node = 0; node < marks.size(); ++node)
        all[node_of_grid(grid_, parts_[k], static_cast<std::int64_t>(node))] = marks[node];
    }
    return all;
  }

  /// Of all parts, by nodes of the grid, ascending.
  Changes changes() const {
    Changes all;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto changes = inside_[k]->changes();
      EXPECT_TRUE(std::ranges::is_sorted(changes, std::ranges::less_equal{}, &InsideMarks::Change::node));
      for (const auto& [node, before, now] : changes)
        all.push_back({node_of_grid(grid_, parts_[k], node), before, now});
    }
    std::ranges::sort(all, {}, &InsideMarks::Change::node);
    return all;
  }

 private:
  Grid grid_;
  std::vector<GridPart> parts_;
  std::vector<std::unique_ptr<InsideMarks>> inside_;
};

bool same_changes(std::span<const InsideMarks::Change> a, const Changes& b) {
  return std::ranges::equal(a, b, [](const auto& one, const auto& other) {
    return one.node == other.node && one.before == other.before && one.now == other.now;
  });
}

/// What a whole grid says of surfaces; empty: it takes them in.
std::string taken_in(InsideMarks& inside, const std::vector<Surface>& surfaces, bool anew) {
  const Spans spans(surfaces);
  try {
    anew ? inside.mark(spans.positions, spans.triangles) : inside.update(spans.positions, spans.triangles);
  } catch (const InsideError& error) {
    return error.what();
  }
  return "";
}

/// Surfaces across cuts and faces, far outside of the box, on the faces of cells, as long as the box, beyond
/// walls and empty, none of which overlap; they move on from step to step.
std::vector<Surface> surfaces_at(const Grid& grid, int step) {
  const double far = grid.periodic[0] ? 1000.0 * grid.nodes[0] : 0, along = 0.37 * step;
  return {placed(ellipsoid(2, {5.1, 3.2, 3.3}), {1, 2, 3}, 0.3 + 0.1 * step, {12.2 + along, 9.1, 8.3}),
          moved(box({-3, -2, -3}, {2, 1, 3}), {far, 0.05 * step, -along}), Surface{},
          placed(stomatocyte(3, 2.2, 1.1), {2, 1, 0}, 0.2 * step, {20.5 - along, 9.0, 16.2}),
          moved(box({4, 15.5, 2}, {grid.periodic[0] ? 27.0 : 29.0, 17.5, 3}), {0.0, 0.0, 0.25 * step})};
}

TEST(InsideParts, HaveTheMarksAndChangesOfTheWhole) {
  for (const Grid& grid : grids_of(nodes_of_box)) {
    for (const auto& division : divisions) {
      for (const int threads : {1, 3}) {
        if (threads > 1 && division[2] == 1) continue;  // one kind of cut is enough
        InsideMarks whole(grid, 1);
        Parts parts(grid, division, threads);
        for (int step = 0; step < 6; ++step) {
          // Every part has to do with other surfaces as they jump.
          const auto surfaces = surfaces_at(grid, step < 4 ? step : 3 * step);
          const bool anew = step % 3 == 0;
          ASSERT_EQ(taken_in(whole, surfaces, anew), "") << step;
          ASSERT_EQ(parts.take_in(surfaces, anew), "") << step;
          ASSERT_EQ(parts.marks(), Marks(whole.marks().begin(), whole.marks().end()));
          ASSERT_TRUE(same_changes(whole.changes(), parts.changes()));
          ASSERT_FALSE(whole.changes().empty());
        }
      }
    }
  }
}

/// Spoils surfaces in one of many ways, or more.
void spoil(std::vector<Surface>& surfaces, std::mt19937_64& generator) {
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(generator() % n); };
  for (std::size_t k = 0, n = 1 + any(3); k < n; ++k) {
    Surface& surface = surfaces[any(surfaces.size())];
    if (surface.triangles.empty()) continue;
    switch (any(6)) {
      case 0:
        surface.positions[any(surface.positions.size())] = std::nan("");
        break;
      case 1: {  // a hole
        const auto begin =
            surface.triangles.begin() + static_cast<std::ptrdiff_t>(3 * any(surface.triangles.size() / 3));
        surface.triangles.erase(begin, begin + 3);
        break;
      }
      case 2:
        surface = turned_over(surface);
        break;
      case 3:
        surface.positions[any(surface.positions.size())] += 50;
        break;
      default: {  // several at about one place
        const Surface& other = surfaces[any(surfaces.size())];
        if (!other.positions.empty()) surface = moved(other, {0.0, static_cast<double>(any(3)), 0.0});
      }
    }
  }
}

TEST(InsideParts, SayWhatTheWholeSays) {
  std::set<std::string> kinds;  // of messages, by what is in them beside numbers
  for (unsigned seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 generator(seed);
    const Grid grid = grids_of(nodes_of_box)[seed % 4];
    const auto& division = divisions[seed / 4 % divisions.size()];
    const auto good = surfaces_at(grid, 1);
    auto surfaces = good;
    spoil(surfaces, generator);
    InsideMarks whole(grid, 1);
    Parts parts(grid, division, seed % 20 == 0 ? 3 : 1);
    for (const bool anew : {true, false}) {
      ASSERT_EQ(taken_in(whole, good, anew), "");
      ASSERT_EQ(parts.take_in(good, anew), "");
      const std::string message = taken_in(whole, surfaces, anew);
      ASSERT_EQ(parts.take_in(surfaces, anew), message) << seed;
      std::string kind;
      std::ranges::copy_if(message, std::back_inserter(kind), [](char c) { return std::isalpha(c) != 0; });
      kinds.insert(kind);
    }
  }
  // Of positions (three axes), spread, hole, inside out, overlaps with itself, an image and others; or none.
  EXPECT_GT(kinds.size(), 8U);
}

TEST(InsideParts, ThreeSurfacesThatOverlapAtACutAreNamedAsInTheWhole) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  // The last comes from before the cut at x = 12, where the other two begin.
  const std::vector<Surface> surfaces = {box({12, 4, 4}, {15, 7, 7}), box({12, 4, 4}, {15, 7, 7}),
                                         box({8, 4, 4}, {15, 7, 7})};
  Parts parts(grid, {2, 1, 1}, 1);
  InsideMarks whole(grid, 1);
  const std::string message = "coupler: surface 0 and surface 2 overlap at grid node (12, 4, 4)";
  EXPECT_EQ(taken_in(whole, surfaces, true), message);
  EXPECT_EQ(parts.take_in(surfaces, true), message);
}

TEST(InsideParts, AFarSurfaceMayBeLeftOut) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  const Surface near = box({2, 2, 2}, {5, 5, 5}), far = box({14, 2, 2}, {17, 5, 5});
  const std::vector<Surface> both = {far, near}, one = {Surface{}, near};
  InsideMarks with(grid, {{0, 0, 0}, {10, 20, 18}}), without(grid, {{0, 0, 0}, {10, 20, 18}});
  EXPECT_EQ(taken_in(with, both, true), "");
  EXPECT_EQ(taken_in(without, one, true), "");
  EXPECT_TRUE(std::ranges::equal(with.marks(), without.marks()));
  EXPECT_EQ(std::ranges::count(without.marks(), 2), 27);
}

TEST(InsideParts, MustLieInTheGrid) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  for (const GridPart& part : {GridPart{{-1, 0, 0}, {4, 4, 4}}, GridPart{{0, 17, 0}, {4, 4, 4}},
                               GridPart{{0, 0, 0}, {4, 4, 0}}, GridPart{{0, 0, 2147483647}, {4, 4, 4}}})
    EXPECT_THROW(InsideMarks(grid, part), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::coupler::inside_parts_test
