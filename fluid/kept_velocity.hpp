// The velocity that the last step met where forces act on the fluid. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fluid/fluid.hpp"
#include "fluid/pack.hpp"

namespace tanktread::fluid {

/// A membrane asks after each step for the velocity of the nodes that it has just pushed. The step has their
/// populations at hand, while a look-up later fetches 19 numbers a node from all over the memory; so the step
/// leaves the velocity of these packs here.
///
/// It is a copy of what MomentReader finds, to the last bit, and no part of the state. Rows are numbered z ny
/// + y.
template <typename Real>
class KeptVelocity {
 public:
  explicit KeptVelocity(const GridShape& shape)
      : packs_a_row_((shape.nx + pack_size<Real> - 1) / pack_size<Real>),
        turn_of_(packs_a_row_ * shape.ny * shape.nz, 0),
        // Not filled: where no force ever acts the system then need not give any memory.
        values_(std::make_unique_for_overwrite<Real[]>(n_values * turn_of_.size())) {}

  /// What was kept so far is void.
  void forget() { ++turn_; }

  /// Keeps the velocity of the pack that begins at node x of a row.
  void put(std::int64_t row, int x, const std::array<Pack<Real>, 3>& velocity) {
    const std::int64_t pack = row * packs_a_row_ + x / pack_size<Real>;
    for (int component = 0; component < 3; ++component)
      store(&values_[n_values * pack + component * pack_size<Real>], velocity[component]);
    turn_of_[pack] = turn_;
  }

  /// The velocity of the pack that holds node x of a row, if it was kept: of its lane k the component c is
  /// number c size + k of these. Null: it was not kept. Valid until forget() or put().
  const Real* find(std::int64_t row, std::int64_t x) const {
    const std::int64_t pack = row * packs_a_row_ + x / pack_size<Real>;
    return turn_of_[pack] == turn_ ? &values_[n_values * pack] : nullptr;
  }

 private:
  static constexpr int n_values = 3 * pack_size<Real>;
  std::int64_t packs_a_row_;
  std::int64_t turn_ = 1;              ///< counts how often all was forgotten
  std::vector<std::int64_t> turn_of_;  ///< the turn in which each pack was kept; 0: none
  std::unique_ptr<Real[]> values_;     ///< of each pack: x of its nodes, then y, then z
};

}  // namespace tanktread::fluid
