// The velocity that the last step met where forces act on the fluid. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fluid/collision.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// A membrane asks after each step for the velocity of the nodes that it has just pushed. The step has their
/// populations at hand, while a look-up later fetches 19 numbers a node from all over the memory; so the step
/// leaves the velocity of these packs here.
///
/// It is a copy of what MomentReader finds, to the last bit, and no part of the state. Rows are numbered z ny
/// + y.
class KeptVelocity {
 public:
  explicit KeptVelocity(const GridShape& shape)
      : packs_a_row_((shape.nx + pack_size - 1) / pack_size),
        step_of_(packs_a_row_ * shape.ny * shape.nz, 0),
        // Left as it comes: memory that no force ever touches is then not taken from the system.
        values_(std::make_unique_for_overwrite<double[]>(n_values * step_of_.size())) {}

  /// A step begins: what the one before has kept is void.
  void begin_step() { current_step_ = ++n_steps_; }
  /// Nothing is kept any more.
  void forget() { current_step_ = forgotten; }

  /// Keeps the velocity of the pack that begins at node x of a row.
  void put(std::int64_t row, int x, const std::array<Pack, 3>& velocity) {
    const std::int64_t pack = row * packs_a_row_ + x / pack_size;
    for (int component = 0; component < 3; ++component)
      store(&values_[n_values * pack + component * pack_size], velocity[component]);
    step_of_[pack] = current_step_;
  }

  /// Writes the velocity of node x of a row, if it was kept. @return whether it was
  bool get(std::int64_t row, std::int64_t x, double* velocity) const {
    const std::int64_t pack = row * packs_a_row_ + x / pack_size;
    if (step_of_[pack] != current_step_) return false;
    const double* values = &values_[n_values * pack + x % pack_size];
    for (int component = 0; component < 3; ++component) velocity[component] = values[component * pack_size];
    return true;
  }

 private:
  static constexpr int n_values = 3 * pack_size;
  static constexpr std::int64_t forgotten = -1;
  std::int64_t packs_a_row_;
  std::int64_t n_steps_ = 0, current_step_ = forgotten;  ///< counted from 1
  std::vector<std::int64_t> step_of_;                    ///< the step that kept each pack; 0: none
  std::unique_ptr<double[]> values_;                     ///< of each pack: x of its nodes, then y, then z
};

}  // namespace tanktread::fluid
