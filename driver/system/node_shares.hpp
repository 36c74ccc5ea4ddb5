// Nodes of a box, told apart by the ranks that have them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "driver/system/part_places.hpp"
#include "fluid/fluid.hpp"
#include "ranks/division.hpp"

namespace tanktread::driver {

/// The nodes of a list that one rank has.
struct NodeShare {
  std::vector<std::int64_t> nodes;  ///< by the rank's own numbers
  std::vector<std::size_t> places;  ///< where they stand in the list
};

/// Lists of nodes divided among ranks. One list after the other: the last one is kept.
class NodeShares {
 public:
  explicit NodeShares(const ranks::Division& division);

  /// Divides a list, unless it is the one of before.
  /// @return whether it is another one @throws std::invalid_argument for a node outside the box; the list of
  /// before is kept then
  bool divide(std::span<const std::int64_t> nodes);

  /// One share a rank, each in the order of the list.
  const std::vector<NodeShare>& shares() const { return shares_; }

 private:
  fluid::GridShape shape_;
  PartPlaces part_places_;
  std::vector<ranks::Block> blocks_;  ///< of each rank
  std::vector<std::int64_t> nodes_;
  std::vector<NodeShare> shares_;
};

/// The numbers of a share, `components` a node, from those of the list.
std::vector<double> taken(std::span<const double> of_list, int components, const NodeShare& share);

/// Puts the numbers of a share to their places in those of the list.
void place(std::span<const double> of_share, int components, const NodeShare& share,
           std::span<double> of_list);

/// Numbers of all nodes of a rank's block, `components` a node, from those of the box.
std::vector<double> block_of(std::span<const double> of_box, int components, const ranks::Division& division,
                             int rank);

/// Puts the numbers of a rank's block to their places in those of the box.
void place_block(std::span<const double> of_block, int components, const ranks::Division& division, int rank,
                 std::span<double> of_box);

}  // namespace tanktread::driver
