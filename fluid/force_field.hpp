// The force on every node: what was added, and the uniform body force. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/collision.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// The total force on the nodes of one row, a component after the other; beyond the row (EndPack) the last
/// node's once more.
struct RowForce {
  explicit RowForce(int nx) : x(nx + pack_size), y(nx + pack_size), z(nx + pack_size) {}
  PackForce pack(int at) const { return {load(&x[at]), load(&y[at]), load(&z[at])}; }
  std::vector<double> x, y, z;
};

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

  /// A force acts on the row. It depends on the values alone, not on how they came there (a force of zero may
  /// have been added): the collisions with and without a force differ in the last bit, and a solver that was
  /// restored must go on as the first one does.
  bool acts_on(std::int64_t row) const;

  void gather(std::int64_t row, RowForce& target) const;

 private:
  std::int64_t nx_;
  std::array<double, 3> body_;
  bool has_body_force_;
  std::vector<double> added_;
  /// The nodes of each row that add() has met lie from begin_ up to end_ (not included); the others are zero,
  /// and skipped. Of a row that it has not met begin_ is nx and end_ 0.
  std::vector<std::int32_t> begin_, end_;
};

}  // namespace tanktread::fluid
