// The force on every node: what was added, and the uniform body force. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// Rows are numbered z ny + y. Memory is taken from the system only where a force has acted.
class ForceField {
 public:
  /// @throws std::bad_alloc
  ForceField(const GridShape& shape, const std::array<double, 3>& body_force, int threads);

  void add(std::span<const std::int64_t> nodes, std::span<const double> force);
  void clear();
  /// Of the rows from `first_row` on. @param added 3 numbers a node, whole rows
  void restore(std::int64_t first_row, std::span<const double> added);

  /// The added force, 3 numbers a node.
  std::span<const double> added() const { return {added_.get(), n_numbers_}; }

  /// Added force on one node, 3 numbers.
  const double* added_to(std::int64_t node) const { return &added_[3 * node]; }

  /// Added and body force on one node.
  std::array<double, 3> total(std::int64_t node) const {
    const double* added = added_to(node);
    return {added[0] + body_[0], added[1] + body_[1], added[2] + body_[2]};
  }

  /// The uniform body force.
  const std::array<double, 3>& body() const { return body_; }
  bool has_body_force() const { return has_body_force_; }

  /// A force may act in the row (one of zero, perhaps).
  bool may_act_in(std::int64_t row) const { return has_body_force_ || reach_[row].end > 0; }

  /// A force may have been added to one of the nodes `x`, ..., `x` + `n` - 1 of a row.
  bool may_be_added_to(std::int64_t row, int x, int n) const {
    return x < reach_[row].end && x + n > reach_[row].begin;
  }

 private:
  /// The nodes of a row that add() has met lie from begin up to end (not included); the others are zero. Of a
  /// row that it has not met begin is nx and end 0.
  struct Reach {
    std::int32_t begin, end;
  };
  struct Release {
    void operator()(double* memory) const { std::free(memory); }
  };

  void add_in_rows(std::span<const std::int64_t> nodes, std::span<const double> force);
  std::int64_t n_rows() const { return static_cast<std::int64_t>(reach_.size()); }

  std::int64_t nx_;
  int n_threads_;
  std::array<double, 3> body_;
  bool has_body_force_;
  std::size_t n_numbers_;
  std::unique_ptr<double[], Release> added_;
  std::vector<Reach> reach_;
};

}  // namespace tanktread::fluid
