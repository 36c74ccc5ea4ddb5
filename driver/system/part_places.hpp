// Which rank has a node, looked up quickly.
#pragma once

#include <array>
#include <vector>

#include "ranks/division.hpp"

namespace tanktread::driver {

/// Division::owner() from a table an axis. Nodes of a periodic axis need not be wrapped.
class PartPlaces {
 public:
  explicit PartPlaces(const ranks::Division& division)
      : n_(division.box().n), periodic_(division.box().periodic), parts_(division.parts()) {
    for (int axis = 0; axis < 3; ++axis) {
      for (ranks::Triple node = {0, 0, 0}; node[axis] < n_[axis]; ++node[axis])
        part_of_[axis].push_back(division.place(division.owner(node))[axis]);
    }
  }

  const ranks::Triple& n_nodes() const { return n_; }
  int n_parts(int axis) const { return parts_[axis]; }
  bool is_periodic(int axis) const { return periodic_[axis]; }

  /// The node within the box.
  int wrapped(int axis, int node) const {
    const int remainder = node % n_[axis];
    return remainder < 0 ? remainder + n_[axis] : remainder;
  }
  /// The part along an axis that has a node.
  int part_of(int axis, int node) const { return part_of_[axis][wrapped(axis, node)]; }
  /// The rank of a part. @param part along x, y, z
  int rank_of(const ranks::Triple& part) const {
    return (part[2] * parts_[1] + part[1]) * parts_[0] + part[0];
  }

 private:
  ranks::Triple n_;
  std::array<bool, 3> periodic_;
  ranks::Triple parts_;
  std::array<std::vector<int>, 3> part_of_;
};

}  // namespace tanktread::driver
