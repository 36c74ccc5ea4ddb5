// Where a part of a box ends, and which populations cross there. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fluid/halo.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// The ends of a part along x, y, z: cuts, walls, or the other end of itself.
class PartBorder {
 public:
  /// @param box all of it, of which this is `part`
  PartBorder(const GridShape& box, const std::optional<WallPair>& walls, const GridPart& part);

  const std::array<int, 3>& box() const { return box_; }      ///< nodes of the whole box along each axis
  const std::array<int, 3>& begin() const { return begin_; }  ///< first node of the part
  const std::array<int, 3>& n() const { return n_; }          ///< nodes of the part

  /// The part does not reach from end to end of the box along an axis.
  bool is_cut(int axis) const { return halo_[axis] != 0; }

  /// Nodes that the halo has at each end of an axis: 0 or 1.
  int halo(int axis) const { return halo_[axis]; }

  /// What leaves the part at one end of an axis comes in at its other end.
  bool wraps(int axis) const { return !is_cut(axis) && wall_axis_ != axis; }

  /// Whether the box goes on behind the cuts in a direction (-1, 0 or 1 along x, y, z).
  bool has_neighbour(const std::array<int, 3>& direction) const;

 private:
  std::array<int, 3> box_, begin_, n_, halo_;
  int wall_axis_;  ///< -1: none
};

/// Nodes whose links along direction i of D3Q19 cross to or from a neighbour: a block, as wide as none or
/// more.
struct CrossingLinks {
  int i;
  std::array<int, 3> begin, end;  ///< along x, y, z; counted from the first node of the part

  std::int64_t size() const;
};

/// At our border (`beyond` false) a link leaves towards the neighbour in `direction`, in our halo one comes
/// from it. One order for both sides. Along the other axes a link must not leave the part: there another
/// neighbour has it, or a wall keeps it. No block is empty.
std::vector<CrossingLinks> crossing_links(const PartBorder& border, const std::array<int, 3>& direction,
                                          bool beyond);

/// The directions of the neighbours that populations go to, in the order of the messages (z slowest).
std::vector<std::array<int, 3>> halo_directions(const PartBorder& border);

}  // namespace tanktread::fluid
