// The nodes of a piece of a divided grid: a rank's own, and a layer of its neighbours'.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/case/case_value.hpp"
#include "driver/system/region_halo.hpp"
#include "exchange/grid_pieces.hpp"
#include "fluid/state.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// The piece of a rank, by the numbers that its file gives to nodes: 0 is the first of the range. None if it
/// has no cells of the range; its last nodes are its neighbour's layer then.
std::optional<exchange::GridBlock> piece_of(const ranks::Division& division, int rank, const Ranges3& range);

/// Numbers of a rank's nodes, as they are asked for.
struct NodeNumbers {
  int components = 1;
  /// Puts there the numbers of some layers of the rank's block.
  std::function<void(fluid::Layers, std::span<double>)> of_layers;
};

/// Brings numbers from a rank's block to its piece: the nodes of a range of the box that it has, and where
/// the range goes on one layer more. In memory are some layers at a time, and the nodes at the cuts.
class PieceNodes {
 public:
  /// World is borrowed; null: the block is the whole box. Together.
  PieceNodes(const ranks::World* world, const ranks::Division& division, const Ranges3& range);

  /// Gives the numbers of the piece's nodes to `take`, in their order, some layers a time. Together: what
  /// `take` throws must not leave it, for the others wait.
  void for_layers(const NodeNumbers& numbers, const std::function<void(std::span<const double>)>& take) const;

 private:
  /// A node at a cut, which goes from one rank to another.
  struct BorderNode {
    std::int64_t in_block;  ///< its number there; -1: another rank's
    std::int64_t in_region;
  };

  void find_border(const Ranges3& range);
  std::vector<double> border_numbers(const NodeNumbers& numbers) const;
  void put_own(const NodeNumbers& numbers, fluid::Layers of_region, std::span<double> values) const;

  ranks::Block block_;
  coupler::GridPart region_;
  std::optional<RegionHalo> halo_;
  std::vector<BorderNode> border_;  ///< ascending in the region
};

}  // namespace tanktread::driver
