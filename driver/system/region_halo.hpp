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
  const std::vector<std::int64_t>& own_nodes() const { return own_nodes_; }
  /// Their places in the list.
  const std::vector<std::size_t>& own_places() const { return own_places_; }

  /// Numbers of the rank's own nodes, put to their places in those of the list.
  void place_own(std::span<const double> of_own, int components, std::span<double> of_list) const;
  /// Taken from there.
  void take_own(std::span<const double> of_list, int components, std::vector<double>& of_own) const;

  /// Fills in the numbers of the nodes that others have, `components` a node, where each rank has filled in
  /// its own. Together.
  void complete(int components, std::span<double> of_list) const;

 private:
  /// Nodes that go to a rank, or come from it: their places in the list.
  struct Share {
    int rank;
    std::vector<std::size_t> places;
  };

  void take_in(std::span<const std::int64_t> nodes);
  void answer(std::vector<ranks::Message> requests);

  const ranks::World& world_;
  PartPlaces places_;
  std::vector<ranks::Block> blocks_;  ///< of each rank
  coupler::GridPart region_;
  std::vector<std::int64_t> own_nodes_;
  std::vector<std::size_t> own_places_;
  std::vector<std::vector<std::int64_t>> wanted_;        ///< of each rank, by its own numbers
  std::vector<std::vector<std::size_t>> wanted_places_;  ///< their places in the list
  std::vector<Share> asked_;                             ///< of this rank by others, ascending by rank
  std::vector<int> owners_;                              ///< ranks that have something of this one's list
};

}  // namespace tanktread::driver
