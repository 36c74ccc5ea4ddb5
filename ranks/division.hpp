// How a box of grid nodes is divided among ranks. Knows no MPI.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace tanktread::ranks {

using Triple = std::array<int, 3>;  ///< along x, y, z

/// A block of nodes.
struct Block {
  Triple begin = {0, 0, 0};  ///< its first node
  Triple n = {0, 0, 0};      ///< its nodes along x, y, z
  bool operator==(const Block&) const = default;
};

/// What is to be divided.
struct Box {
  Triple n = {0, 0, 0};                               ///< nodes along x, y, z
  std::array<bool, 3> periodic = {true, true, true};  ///< false: walls at both ends
  Triple least = {1, 1, 1};                           ///< nodes that a part must have at least
};

/// A box cut into parts.x x parts.y x parts.z blocks, one a rank, as alike as can be: along an axis of n
/// nodes part k of p begins at node floor(k n/p). Ranks count along x first, then y, then z.
class Division {
 public:
  /// @throws std::invalid_argument naming the axis, if a part has less nodes than it must; with what would do
  Division(const Box& box, const Triple& parts);

  const Box& box() const { return box_; }
  const Triple& parts() const { return parts_; }
  int n_ranks() const { return parts_[0] * parts_[1] * parts_[2]; }

  /// Nodes of a rank.
  Block block(int rank) const;

  /// The rank that has a node.
  int owner(const Triple& node) const;

  /// Its place among the parts along x, y, z.
  Triple place(int rank) const;

  /// The rank next to another in a direction (-1, 0 or 1 along x, y, z), round the box where it is periodic;
  /// none behind a wall. It may be the rank itself, or the same in two directions.
  std::optional<int> neighbour(int rank, const Triple& direction) const;

  /// Nodes on one side of all cuts together: what crosses them goes with it.
  std::int64_t cut_surface() const;

 private:
  int begin(int axis, int part) const;

  Box box_;
  Triple parts_;
};

/// The division into `n_ranks` parts with the least cut surface. Of several that with the fewest parts along
/// x, then along y: rows lie along x, so that a cut across z goes through whole rows.
/// @throws std::invalid_argument if there is none, naming the greatest number of ranks below `n_ranks` for
/// which there is one
Division least_surface(const Box& box, int n_ranks);

}  // namespace tanktread::ranks
