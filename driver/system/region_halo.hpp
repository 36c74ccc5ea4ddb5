// The grid nodes that a rank's stencils touch: its own, and those of the ranks around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/system/part_places.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// Numbers on the nodes of a list (Coupler::grid_nodes() of a part of the grid), most of which this rank has
/// itself; the others are brought from their owners. All ranks call find() together, and complete() after
/// it, as often as they like.
class RegionHalo {
 public:
  /// World is borrowed. @param region of the rank's coupler
  RegionHalo(const ranks::World& world, const ranks::Division& division, const coupler::GridPart& region);

  /// Takes in a list, and tells the owners of what is another rank's. Together.
  /// @param nodes linear indices within the region, ascending
  /// @throws std::logic_error if another rank asks for a node that is in this rank's block and not in its
  /// list
  void find(std::span<const std::int64_t> nodes);

  /// The nodes of the list that this rank has, by their numbers in its block, in the order of the list.
  const std::vector<std::int64_t>& own_nodes() const { return own_.nodes; }

  /// Numbers of the rank's own nodes, put to their places in those of the list.
  void place_own(std::span<const double> of_own, int components, std::span<double> of_list) const;
  /// Taken from there.
  void take_own(std::span<const double> of_list, int components, std::vector<double>& of_own) const;

  /// Fills in the numbers of the nodes that others have, `components` a node, where each rank has filled in
  /// its own. Together.
  void complete(int components, std::span<double> of_list) const;

 private:
  /// Places in the list that follow each other.
  struct Run {
    std::size_t first, n;
  };
  /// Nodes of the list that one rank has.
  struct Nodes {
    std::vector<std::int64_t> nodes;  ///< by its own numbers
    std::vector<Run> runs;            ///< where they stand in the list

    void add(std::int64_t node, std::size_t place);
  };
  /// Nodes of this rank that another asks for.
  struct Asked {
    int rank;
    std::size_t n_nodes;
    std::vector<Run> runs;
  };
  /// Neighbours along x that one rank has.
  struct Segment {
    std::int64_t begin = 0, end = -1;  ///< indices within the region
    std::size_t rank = 0;
    std::int64_t shift = 0;  ///< from there to the number in the rank's block
  };

  Segment segment_from(std::int64_t node) const;
  void take_in(std::span<const std::int64_t> nodes);
  void answer(std::vector<ranks::Message> requests);

  const ranks::World& world_;
  PartPlaces places_;
  std::vector<ranks::Block> blocks_;  ///< of each rank
  coupler::GridPart region_;
  Nodes own_;
  std::vector<Nodes> wanted_;  ///< of each rank
  std::vector<Asked> asked_;   ///< ascending by rank
  std::vector<int> owners_;    ///< ranks that have something of this one's list
};

}  // namespace tanktread::driver
