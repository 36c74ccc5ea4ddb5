// The force on every node: what was added, and the uniform body force. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/collision.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// Rows are numbered z ny + y.
class ForceField {
 public:
  ForceField(const GridShape& shape, const std::array<double, 3>& body_force);

  void add(std::span<const std::int64_t> nodes, std::span<const double> force);
  void clear();
  void restore(std::span<const double> added);

  /// The added force, 3 numbers a node.
  const std::vector<double>& added() const { return added_; }

  /// Added and body force on one node.
  std::array<double, 3> total(std::int64_t node) const {
    return {added_[3 * node] + body_[0], added_[3 * node + 1] + body_[1], added_[3 * node + 2] + body_[2]};
  }

  /// A force may act in the row (one of zero, perhaps).
  bool may_act_in(std::int64_t row) const { return has_body_force_ || end_[row] > 0; }

  bool has_body_force() const { return has_body_force_; }

  /// A force other than zero was added to one of the nodes `x`, ..., `x` + `n_lanes` - 1 of a row.
  bool added_to(std::int64_t row, int x, int n_lanes) const {
    if (x >= end_[row] || x + n_lanes <= begin_[row]) return false;
    // One OR a number in place of a jump a number: the bits without the sign are zero only if all numbers
    // are.
    const double* force = &added_[3 * (row * nx_ + x)];
    std::uint64_t bits = 0;
    for (int k = 0; k < 3 * n_lanes; ++k) bits |= std::bit_cast<std::uint64_t>(force[k]) << 1;
    return bits != 0;
  }

  /// The body force on a pack.
  PackForce body_force() const { return {Pack{} + body_[0], Pack{} + body_[1], Pack{} + body_[2]}; }

  /// The total force on these nodes; lanes beyond the last repeat it (EndPack).
  PackForce total(std::int64_t row, int x, int n_lanes) const {
    PackForce force;
    for (int lane = 0; lane < pack_size; ++lane) {
      const double* added = &added_[3 * (row * nx_ + x + std::min(lane, n_lanes - 1))];
      force.x[lane] = added[0];
      force.y[lane] = added[1];
      force.z[lane] = added[2];
    }
    return {force.x + body_[0], force.y + body_[1], force.z + body_[2]};
  }

 private:
  std::int64_t nx_;
  std::array<double, 3> body_;
  bool has_body_force_;
  std::vector<double> added_;
  /// The nodes of each row that add() has met lie from begin_ up to end_ (not included); the others are zero.
  /// Of a row that it has not met begin_ is nx and end_ 0.
  std::vector<std::int32_t> begin_, end_;
};

}  // namespace tanktread::fluid
