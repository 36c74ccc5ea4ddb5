// Which grid nodes a stencil takes, what is refused and in what words, and what a refusal leaves behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Grid walled_in_z = {{12, 10, 14}, {true, true, false}};

/// The message of the StencilError that building the surfaces throws; empty if it throws none.
std::string refusal(Coupler& coupler, const std::vector<Numbers>& surfaces) {
  try {
    build(coupler, surfaces);
  } catch (const StencilError& error) {
    return error.what();
  }
  return "";
}

TEST(CouplerStencils, TouchTheBoxOfNodesAroundANode) {
  // 5.3 lies between node 4 (at 4.5) and node 5 (at 5.5): cosine4 takes 3 to 6; y and z alike.
  Coupler coupler(walled_in_z, kernel("cosine4"));
  build(coupler, {{5.3, 3.9, 7.0}});
  std::vector<std::int64_t> expected;
  for (int k = 5; k <= 8; ++k)
    for (int j = 2; j <= 5; ++j)
      for (int i = 3; i <= 6; ++i) expected.push_back((k * 10 + j) * 12 + i);
  EXPECT_TRUE(std::ranges::equal(coupler.grid_nodes(), expected));
}

TEST(CouplerStencils, AListThatIsHeldDoesNotChange) {
  Coupler coupler(walled_in_z, kernel("cosine4"));
  build(coupler, {{5.3, 3.9, 7.0}});
  const auto held = coupler.grid_node_list();
  const std::vector<std::int64_t> before = *held;
  for (const double x : {7.1, 2.2}) {  // two builds: the lists take turns
    build(coupler, {{x, 3.9, 7.0}});
    EXPECT_NE(*coupler.grid_node_list(), before);
  }
  EXPECT_EQ(*held, before);
}

TEST(CouplerStencils, WrapAroundThePeriodicFaces) {
  Coupler coupler(walled_in_z, kernel("roma3"));
  build(coupler, {{0.4, 9.9, 7.0}});  // nearest node along x 0 (at 0.5), along y 9 (at 9.5), along z 6 and 7
  std::set<int> x, y;
  for (const auto node : coupler.grid_nodes()) {
    x.insert(indices_of(walled_in_z, node)[0]);
    y.insert(indices_of(walled_in_z, node)[1]);
  }
  EXPECT_EQ(x, (std::set<int>{11, 0, 1}));
  EXPECT_EQ(y, (std::set<int>{8, 9, 0}));
}

class CouplerStencilsOf : public ::testing::TestWithParam<Kernel> {};

TEST_P(CouplerStencilsOf, ListEachNodeOnceAscendingAndJustThoseWithinReach) {
  // x has 130 nodes: a row is more than two machine words long, and runs cross the words' borders.
  const Grid grid = {{130, 12, 13}, {true, true, true}};
  const std::vector<Numbers> surfaces = {sphere(150, 4.0, {63.0, 6.0137, 6.0137}),
                                         sphere(100, 3.0, {129.0, 1.0137, 2.0137})};
  Coupler coupler(grid, GetParam());
  build(coupler, surfaces);
  const auto nodes = coupler.grid_nodes();
  EXPECT_EQ(std::ranges::adjacent_find(nodes, std::greater_equal<>()), nodes.end());

  std::set<std::int64_t> within_reach;
  const auto near = [&](double x, int index, int axis) {
    return std::abs(std::remainder(x - (index + 0.5), grid.nodes[axis])) < GetParam().half_width;
  };
  for (std::int64_t node = 0; node < 130 * 12 * 13; ++node) {
    const auto index = indices_of(grid, node);
    for (const auto& surface : surfaces) {
      for (std::size_t m = 0; m < surface.size(); m += 3) {
        if (near(surface[m], index[0], 0) && near(surface[m + 1], index[1], 1) &&
            near(surface[m + 2], index[2], 2))
          within_reach.insert(node);
      }
    }
  }
  // No coordinate is a multiple of 1/2, so no node lies just at the half-width, where either answer is right.
  for (const double x : joined(surfaces)) ASSERT_NE(2 * x, std::round(2 * x));
  EXPECT_TRUE(std::ranges::equal(nodes, within_reach));
}

TEST_P(CouplerStencilsOf, DoNotFeelWholePeriods) {
  const Grid grid = {{16, 17, 18}, {true, true, true}};
  const Numbers surface = sphere(100, 6.0, {8.0, 8.0, 8.0});
  Coupler near(grid, GetParam()), far(grid, GetParam());
  build(near, {surface});
  const Numbers field = random_numbers(3 * near.grid_nodes().size(), -1.0, 1.0, 1);
  for (const double periods : {1.0, -1.0, 7.0, -1000.0, 65536.0}) {
    build(far, {shifted(shifted(shifted(surface, 0, 16 * periods), 1, 17 * periods), 2, -18 * periods)});
    ASSERT_TRUE(std::ranges::equal(far.grid_nodes(), near.grid_nodes())) << periods;
    EXPECT_EQ(interpolate(far, field, {100}), interpolate(near, field, {100})) << periods;
  }
}

TEST_P(CouplerStencilsOf, MayReachJustToAWallAndNotBeyond) {
  // The first node beyond a wall is half a step behind it: a distance of half_width - 1/2 is just enough.
  const double closest = GetParam().half_width - 0.5, little = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    Grid grid = {{9, 10, 11}, {true, true, true}};
    grid.periodic[axis] = false;
    Coupler coupler(grid, GetParam());
    const Numbers middle = {4.5, 5.0, 5.5};
    for (const bool low : {true, false}) {
      const double inward = low ? 1.0 : -1.0, at = (low ? 0.0 : grid.nodes[axis]) + inward * closest;
      Numbers node = middle;
      node[axis] = at;
      EXPECT_EQ(refusal(coupler, {node}), "") << axis << low;
      for (const auto grid_node : coupler.grid_nodes()) {
        ASSERT_GE(grid_node, 0);
        ASSERT_LT(grid_node, 9 * 10 * 11);
      }
      const Numbers ones(3 * coupler.grid_nodes().size(), 1.0);
      EXPECT_NEAR(interpolate(coupler, ones, {1})[0], 1.0, 32 * eps);  // nothing of the stencil is lost
      node[axis] = at + inward * little;
      EXPECT_EQ(refusal(coupler, {node}), "");
      node[axis] = at - inward * little;
      EXPECT_THAT(refusal(coupler, {node}), HasSubstr(std::string("wall at ") + "xyz"[axis])) << axis << low;
    }
  }
}

TEST(CouplerStencils, AWeightThatRoundsToZeroNeedsNoNode) {
  // One rounding nearer to the wall than cosine4 may be, its weight behind the wall is of order eps^2, that
  // is 0.
  Coupler coupler(walled_in_z, kernel("cosine4"));
  for (const double z : {std::nextafter(1.5, 0.0), std::nextafter(12.5, 14.0)}) {
    EXPECT_EQ(refusal(coupler, {{5, 5, z}}), "");
    const Numbers ones(3 * coupler.grid_nodes().size(), 1.0);
    EXPECT_NEAR(interpolate(coupler, ones, {1})[2], 1.0, 32 * eps);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CouplerStencilsOf, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

TEST(CouplerStencils, RefusalAtAWallNamesSurfaceNodePositionKernelAndDistances) {
  Coupler coupler(walled_in_z, kernel("cosine4"));
  EXPECT_EQ(
      refusal(coupler, {{5, 5, 7}, {5, 5, 7, 2.5, 3.25, 12.75, 5, 5, 0.5}}),
      "coupler: surface 1, node 1 at (2.5, 3.25, 12.75): its distance from the wall at z = 14 is 1.25 grid "
      "steps; kernel 'cosine4' of half-width 2 needs at least 1.5");
  EXPECT_EQ(
      refusal(coupler, {{5, 5, 0.25}}),
      "coupler: surface 0, node 0 at (5, 5, 0.25): its distance from the wall at z = 0 is 0.25 grid steps; "
      "kernel 'cosine4' of half-width 2 needs at least 1.5");
  EXPECT_THAT(refusal(coupler, {{5, 5, -100.0}}), HasSubstr("wall at z = 0 is -100 grid steps"));
}

TEST(CouplerStencils, RefusalNamesTheFirstNodeForAnyNumberOfThreads) {
  Numbers surface = sphere(400, 4.0, {6.0, 5.0, 7.0});
  for (const std::size_t node : {397, 205, 77, 300}) surface[3 * node + 2] = 0.0;
  for (const int threads : {1, 2, 4}) {
    Coupler coupler(walled_in_z, kernel("peskin4"), threads);
    EXPECT_THAT(refusal(coupler, {surface}), HasSubstr("surface 0, node 77 at"));
  }
}

TEST(CouplerStencils, RefusePositionsThatAreNotFiniteOrOutOfReach) {
  Coupler coupler(walled_in_z, kernel("cosine4"));
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double value : {nan, infinity, -infinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      Numbers surface = {5, 5, 7, 5, 5, 7};
      surface[3 + axis] = value;
      EXPECT_THAT(refusal(coupler, {surface}), AllOf(HasSubstr("surface 0, node 1"),
                                                     HasSubstr(std::string{"xyz"[axis]} + " is not finite")));
    }
  }
  EXPECT_THAT(refusal(coupler, {{5, -1e12, 7}}),
              HasSubstr("y is more than 1.0737418e+09 grid steps from the origin"));
  EXPECT_THAT(refusal(coupler, {{1e300, 5, 7}}), HasSubstr("x is more than"));
}

TEST(CouplerStencils, ARefusalLeavesTheOldStencils) {
  Coupler coupler(walled_in_z, kernel("cosine4"));
  const std::vector<Numbers> good = {sphere(60, 4.0, {6, 5, 7}), sphere(40, 3.0, {1, 1, 7})};
  build(coupler, good);
  const std::vector<std::int64_t> nodes(coupler.grid_nodes().begin(), coupler.grid_nodes().end());
  const Numbers field = random_numbers(3 * nodes.size(), -1, 1, 2);
  const Numbers velocity = interpolate(coupler, field, {60, 40});
  const Numbers force = spread(coupler, good);

  EXPECT_NE(refusal(coupler, {sphere(70, 4.0, {2, 3, 7}), sphere(80, 3.0, {5, 5, 7}), {5, 5, 1.0}}), "");
  ASSERT_TRUE(std::ranges::equal(coupler.grid_nodes(), nodes));
  EXPECT_EQ(interpolate(coupler, field, {60, 40}), velocity);
  EXPECT_EQ(spread(coupler, good), force);

  // The next good build is that of a fresh coupler: nothing of the failed one is left.
  const std::vector<Numbers> next = {sphere(50, 3.0, {6, 5, 7})};
  build(coupler, next);
  Coupler fresh(walled_in_z, kernel("cosine4"));
  build(fresh, next);
  ASSERT_TRUE(std::ranges::equal(coupler.grid_nodes(), fresh.grid_nodes()));
  EXPECT_EQ(spread(coupler, next), spread(fresh, next));
}

TEST(CouplerStencils, NoSurfaceAndEmptySurfacesAreInOrder) {
  Coupler coupler(walled_in_z, kernel("cosine4"));
  EXPECT_TRUE(coupler.grid_nodes().empty());
  EXPECT_TRUE(interpolate(coupler, {}, {}).empty());
  build(coupler, {{}, {5, 5, 7}, {}});
  EXPECT_EQ(coupler.grid_nodes().size(), 64u);
  EXPECT_EQ(interpolate(coupler, Numbers(3 * 64, 1.0), {0, 1, 0}).size(), 3u);
  build(coupler, {});
  EXPECT_TRUE(coupler.grid_nodes().empty());
  EXPECT_TRUE(spread(coupler, {}).empty());
}

TEST(CouplerStencils, AGridNarrowerThanTheKernelIsRefused) {
  const auto construct = [](const Grid& grid, const char* name) {
    return complaint([&] { Coupler(grid, kernel(name)); });
  };
  EXPECT_EQ(
      construct({{8, 3, 8}, {true, true, true}}, "cosine4"),
      "coupler: axis y has 3 grid nodes, but kernel 'cosine4' is 4 wide: use at least as many nodes, or a "
      "narrower kernel");
  EXPECT_EQ(construct({{8, 3, 8}, {true, true, true}}, "roma3"), "");
  EXPECT_THAT(construct({{8, 8, 0}, {true, true, true}}, "linear2"), HasSubstr("axis z has 0 grid nodes"));
  EXPECT_THAT(construct({{2, 8, 8}, {false, true, true}}, "roma3"), HasSubstr("axis x has 2 grid nodes"));
}

TEST(CouplerStencils, WrongArgumentsAreRefused) {
  EXPECT_THAT(complaint([] { Coupler(walled_in_z, kernel("roma3"), -1); }), HasSubstr("threads = -1"));
  Kernel wide = kernel("roma3");
  wide.half_width = 3.5;
  EXPECT_THAT(complaint([&] { Coupler(walled_in_z, wide); }), HasSubstr("half-width"));
  Kernel empty = kernel("roma3");
  empty.function = nullptr;
  EXPECT_THAT(complaint([&] { Coupler(walled_in_z, empty); }), HasSubstr("needs a function"));

  Coupler coupler(walled_in_z, kernel("linear2"));
  EXPECT_THAT(complaint([&] {
                build(coupler, {{5, 5, 7}, {5, 5}});
              }),
              HasSubstr("surface 1 has 2 coordinates"));
  build(coupler, {{5, 5, 7}, {6, 6, 8, 6, 6, 9}});
  const Numbers field(3 * coupler.grid_nodes().size(), 1.0);
  EXPECT_THAT(complaint([&] {
                interpolate(coupler, {1, 2, 3}, {1, 2});
              }),
              HasSubstr("grid_velocity: 3 given"));
  EXPECT_THAT(complaint([&] { interpolate(coupler, field, {1}); }), HasSubstr("surfaces: 1 given, 2 needed"));
  EXPECT_THAT(complaint([&] {
                interpolate(coupler, field, {1, 1});
              }),
              HasSubstr("numbers of surface 1: 3 given, 6 needed"));
  EXPECT_THAT(complaint([&] { spread(coupler, {{1, 1, 1}}); }), HasSubstr("node_force, surfaces: 1 given"));
}

}  // namespace
}  // namespace tanktread::coupler
