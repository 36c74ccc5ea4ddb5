// How a box is divided: every node has one rank, neighbours agree, the cut is the least.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ranks/division.hpp"

namespace tanktread::ranks {

void PrintTo(const Division& division, std::ostream* out) {
  const auto &n = division.box().n, &parts = division.parts();
  *out << n[0] << " x " << n[1] << " x " << n[2] << " in " << parts[0] << " x " << parts[1] << " x "
       << parts[2];
}

namespace test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::array<bool, 3> channel = {true, true, false};  // walls across z

const Division divisions[] = {
    {{{7, 5, 4}}, {1, 1, 1}},  {{{7, 5, 4}}, {2, 1, 3}},           {{{7, 5, 4}}, {7, 5, 4}},
    {{{13, 6, 9}}, {3, 4, 2}}, {{{13, 6, 9}, channel}, {1, 2, 5}}, {{{64, 1, 33}, channel}, {5, 1, 7}},
};

class RanksDivision : public testing::TestWithParam<Division> {};
INSTANTIATE_TEST_SUITE_P(every, RanksDivision, testing::ValuesIn(divisions));

TEST_P(RanksDivision, gives_every_node_to_one_rank) {
  const auto& division = GetParam();
  const auto& n = division.box().n;
  std::vector<int> times(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0);
  for (int rank = 0; rank < division.n_ranks(); ++rank) {
    const auto block = division.block(rank);
    for (int z = block.begin[2]; z < block.begin[2] + block.n[2]; ++z)
      for (int y = block.begin[1]; y < block.begin[1] + block.n[1]; ++y)
        for (int x = block.begin[0]; x < block.begin[0] + block.n[0]; ++x) {
          EXPECT_EQ(division.owner({x, y, z}), rank);
          ++times[(static_cast<std::size_t>(z) * n[1] + y) * n[0] + x];
        }
  }
  EXPECT_THAT(times, testing::Each(1));
}

TEST_P(RanksDivision, makes_parts_alike) {
  const auto& division = GetParam();
  for (int rank = 0; rank < division.n_ranks(); ++rank) {
    for (int axis = 0; axis < 3; ++axis) {
      const int n = division.block(rank).n[axis], even = division.box().n[axis] / division.parts()[axis];
      EXPECT_GE(n, even);
      EXPECT_LE(n, even + 1);
    }
  }
}

// The neighbour of a neighbour, the other way, is oneself; and its block begins where one's own ends, round
// the box. Behind a wall there is none.
TEST_P(RanksDivision, neighbours_agree) {
  const auto& division = GetParam();
  const auto& box = division.box();
  for (int rank = 0; rank < division.n_ranks(); ++rank) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Triple direction = {0, 0, 0};
        direction[axis] = side;
        const auto own = division.block(rank);
        const int behind = side < 0 ? own.begin[axis] - 1 : own.begin[axis] + own.n[axis];
        const auto neighbour = division.neighbour(rank, direction);
        if (!box.periodic[axis] && (behind < 0 || behind >= box.n[axis])) {
          EXPECT_FALSE(neighbour);
          continue;
        }
        ASSERT_TRUE(neighbour);
        Triple node = own.begin;
        node[axis] = (behind + box.n[axis]) % box.n[axis];
        EXPECT_EQ(division.owner(node), *neighbour);
        EXPECT_EQ(division.neighbour(*neighbour, {-direction[0], -direction[1], -direction[2]}), rank);
      }
    }
  }
}

TEST(RanksDivisionOfCorners, a_neighbour_may_be_along_two_axes_and_round_the_box) {
  const Division division({{8, 8, 8}}, {2, 4, 2});
  EXPECT_EQ(division.place(0), (Triple{0, 0, 0}));
  EXPECT_EQ(division.neighbour(0, {0, -1, -1}), 14);  // place (0, 3, 1)
  EXPECT_EQ(division.neighbour(0, {-1, 1, 1}), 11);   // place (1, 1, 1)
}

struct Least {
  Box box;
  int n_ranks;
  Triple parts;
};
void PrintTo(const Least& least, std::ostream* out) {
  PrintTo(Division(least.box, least.parts), out);
}
class RanksLeastSurface : public testing::TestWithParam<Least> {};

// By hand, for a cube of n^3 nodes. Two slabs are cut twice if the box is periodic, 2 n^2. Four slabs 4 n^2,
// and 2 x 2 columns 2 + 2: the same, then the one with fewer parts along y. Eight slabs 8 n^2, columns of 2 x
// 4, as cubes of 2 x 2 x 2, 6: then the one without cuts along x. Between walls an axis has one cut less: 8
// are 2 + 3 as 1 x 2 x 4, 2 + 2 + 1 as cubes. A long box is cut along its length, whatever the axis.
INSTANTIATE_TEST_SUITE_P(
    every, RanksLeastSurface,
    testing::Values(Least{{{60, 60, 60}}, 1, {1, 1, 1}}, Least{{{60, 60, 60}}, 2, {1, 1, 2}},
                    Least{{{60, 60, 60}}, 4, {1, 1, 4}}, Least{{{60, 60, 60}}, 8, {1, 2, 4}},
                    Least{{{60, 60, 60}}, 27, {3, 3, 3}}, Least{{{60, 60, 60}, channel}, 2, {1, 1, 2}},
                    Least{{{60, 60, 60}, channel}, 8, {1, 2, 4}}, Least{{{400, 20, 20}}, 4, {4, 1, 1}},
                    Least{{{20, 400, 20}}, 6, {1, 6, 1}}, Least{{{60, 60, 60}}, 7, {1, 1, 7}}));

TEST_P(RanksLeastSurface, is_found) {
  const auto& [box, n_ranks, parts] = GetParam();
  EXPECT_EQ(least_surface(box, n_ranks).parts(), parts);
}

/// The slow way: all triples with the product, few parts along x first, then along y.
std::optional<Triple> least_of_all(const Box& box, int n_ranks) {
  std::optional<Triple> best;
  std::int64_t least = 0;
  for (int x = 1; x <= std::min(n_ranks, box.n[0] / box.least[0]); ++x)
    for (int y = 1; y <= std::min(n_ranks / x, box.n[1] / box.least[1]); ++y) {
      const int z = n_ranks / x / y;
      if (x * y * z != n_ranks || z > box.n[2] / box.least[2]) continue;
      const auto surface = Division(box, {x, y, z}).cut_surface();
      if (best && surface >= least) continue;
      best = {x, y, z};
      least = surface;
    }
  return best;
}

// No other way to cut has less surface, of few ranks and of many.
TEST(RanksLeastSurfaceOfAll, is_the_least_of_all_ways) {
  std::vector<int> numbers(24);
  std::iota(numbers.begin(), numbers.end(), 1);
  for (const int many : {360, 1009, 4096, 46656, 65536, 99999, 100'000, 1'000'000}) numbers.push_back(many);
  for (const Box& box : {Box{{30, 40, 50}}, Box{{64, 16, 24}, channel}, Box{{12, 12, 12}, channel, {3, 4, 2}},
                         Box{{400, 400, 400}, channel, {3, 1, 1}}}) {
    for (const int n_ranks : numbers) {
      const auto least = least_of_all(box, n_ranks);
      if (least) {
        EXPECT_EQ(least_surface(box, n_ranks).parts(), *least) << n_ranks;
      } else {
        EXPECT_THROW(least_surface(box, n_ranks), std::invalid_argument) << n_ranks;
      }
    }
  }
}

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RanksDivisionRefused, says_what_would_do) {
  const Box box{{12, 8, 8}, channel, {3, 4, 4}};
  EXPECT_EQ(refusal_of([&] { Division(box, {4, 2, 2}); }), "");
  EXPECT_THAT(refusal_of([&] {
                Division(box, {5, 2, 2});
              }),
              AllOf(HasSubstr("5 parts along x"), HasSubstr("12 x 8 x 8"), HasSubstr("1 to 4"),
                    HasSubstr("3 nodes")));
  EXPECT_THAT(refusal_of([&] { Division(box, {1, 0, 2}); }), HasSubstr("0 parts along y"));
  // 16 = 4 x 2 x 2 is the most; 17 is a prime, 32 too many.
  EXPECT_THAT(refusal_of([&] { least_surface(box, 17); }),
              AllOf(HasSubstr("17 ranks"), HasSubstr("; 16 would do")));
  EXPECT_THAT(refusal_of([&] { least_surface(box, 32); }), HasSubstr("; 16 would do"));
  EXPECT_THAT(refusal_of([&] { least_surface(box, 0); }), HasSubstr("0 ranks"));
  // At once, not by trying two thousand million numbers.
  EXPECT_THAT(refusal_of([&] { least_surface(box, std::numeric_limits<int>::max()); }),
              HasSubstr("; 16 would do"));
}

}  // namespace
}  // namespace test
}  // namespace tanktread::ranks
