// Lists and arrays of nodes, divided among ranks and put together again.
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "driver/system/node_shares.hpp"

namespace tanktread::driver::node_shares_test {
namespace {

using Nodes = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

const ranks::Division divisions[] = {
    {{{9, 5, 4}}, {1, 1, 1}}, {{{9, 5, 4}}, {1, 1, 3}}, {{{9, 5, 4}}, {3, 2, 2}}};

/// Where a node of a rank is in the box.
std::int64_t in_box(const ranks::Division& division, int rank, std::int64_t node) {
  const auto [begin, n] = division.block(rank);
  const std::int64_t x = node % n[0], y = node / n[0] % n[1], z = node / n[0] / n[1];
  return ((z + begin[2]) * division.box().n[1] + y + begin[1]) * division.box().n[0] + x + begin[0];
}

// A list in no order, with nodes twice: every place in it is in one share, with the node that stands there.
TEST(NodeShares, hold_every_place_of_a_list_once) {
  const Nodes list = {179, 0, 44, 45, 0, 100, 101, 102, 103, 90, 91, 179, 8, 9};
  for (const auto& division : divisions) {
    NodeShares shares(division);
    EXPECT_TRUE(shares.divide(list));
    std::vector<int> times(list.size(), 0);
    for (int rank = 0; rank < division.n_ranks(); ++rank) {
      const auto& share = shares.shares()[rank];
      ASSERT_EQ(share.nodes.size(), share.places.size());
      for (std::size_t k = 0; k < share.nodes.size(); ++k) {
        EXPECT_EQ(in_box(division, rank, share.nodes[k]), list[share.places[k]]);
        ++times[share.places[k]];
        if (k > 0) {
          EXPECT_LT(share.places[k - 1], share.places[k]);
        }
      }
    }
    EXPECT_EQ(times, std::vector<int>(list.size(), 1));
  }
}

TEST(NodeShares, say_whether_a_list_is_another) {
  NodeShares shares(divisions[2]);
  EXPECT_FALSE(shares.divide(Nodes{}));  // none is meant at first
  EXPECT_TRUE(shares.divide(Nodes{1, 2}));
  EXPECT_FALSE(shares.divide(Nodes{1, 2}));
  EXPECT_TRUE(shares.divide(Nodes{2, 1}));
  EXPECT_TRUE(shares.divide(Nodes{}));
}

TEST(NodeShares, refuse_a_node_outside_and_keep_the_list_of_before) {
  NodeShares shares(divisions[2]);
  EXPECT_TRUE(shares.divide(Nodes{1}));
  EXPECT_THROW(shares.divide(Nodes{2, 180}), std::invalid_argument);
  EXPECT_THROW(shares.divide(Nodes{-1}), std::invalid_argument);
  EXPECT_FALSE(shares.divide(Nodes{1}));
  EXPECT_EQ(shares.shares()[0].nodes, Nodes{1});
}

TEST(NodeShares, numbers_come_back_to_their_places) {
  const Nodes list = {179, 0, 44, 45, 100, 8};
  Numbers numbers(3 * list.size());
  std::iota(numbers.begin(), numbers.end(), 1.0);
  for (const auto& division : divisions) {
    NodeShares shares(division);
    shares.divide(list);
    Numbers back(numbers.size());
    for (const auto& share : shares.shares()) place(taken(numbers, 3, share), 3, share, back);
    EXPECT_EQ(back, numbers);
  }
}

TEST(NodeBlocks, numbers_come_back_to_their_places) {
  Numbers numbers(2 * 180);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  for (const auto& division : divisions) {
    Numbers back(numbers.size());
    for (int rank = 0; rank < division.n_ranks(); ++rank) {
      const auto block = block_of(numbers, 2, division, rank);
      EXPECT_EQ(block[1], numbers[2 * in_box(division, rank, 0) + 1]);
      place_block(block, 2, division, rank, back);
    }
    EXPECT_EQ(back, numbers);
    EXPECT_THROW(place_block(Numbers(3), 2, division, 0, back), std::logic_error);
  }
}

}  // namespace
}  // namespace tanktread::driver::node_shares_test
