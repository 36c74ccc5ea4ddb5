// Lists of nodes of a box, told apart by the ranks that have them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluid/fluid.hpp"
#include "ranks/division.hpp"

namespace tanktread::driver {

/// The nodes of a list that one rank has.
struct NodeShare {
  std::vector<std::int64_t> nodes;  ///< by the rank's own numbers
  std::vector<std::size_t> places;  ///< where they stand in the list
};

/// One share a rank, each in the order of the list. @throws std::invalid_argument for a node outside the box
std::vector<NodeShare> node_shares(const ranks::Division& division, std::span<const std::int64_t> nodes);

/// The nodes of the box that a rank has, in the order of its own numbers.
std::vector<std::int64_t> nodes_of_rank(const ranks::Division& division, int rank);

/// The numbers of a share, `components` a node, from those of the list.
std::vector<double> taken(std::span<const double> of_list, int components, const NodeShare& share);

/// Puts the numbers of a share to their places in those of the list.
void place(std::span<const double> of_share, int components, const NodeShare& share,
           std::span<double> of_list);

}  // namespace tanktread::driver
