// What the next step meets on a node, read from the populations that will come in. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fluid/collision.hpp"
#include "fluid/force_field.hpp"
#include "fluid/pack_forces.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/row_packs.hpp"

namespace tanktread::fluid {

/// Reads velocity and mobility (Fluid::free_velocity) of one node after the other, by the packs and the sums
/// of the step itself. Nodes that follow each other share the look-up of their row and their pack, so each
/// thread has a reader of its own; what it finds does not depend on what was asked before. Lattice and
/// forces are borrowed and must outlive it.
template <typename Real>
class IncomingReader {
 public:
  /// @param force of which only the body force counts
  /// @param next the kind of the step that will be done next
  IncomingReader(const PopulationLattice<Real>& lattice, const ForceField& force, Turn next, bool inertia)
      : lattice_(lattice),
        nx_(lattice.shape().nx),
        inertia_(inertia),
        half_body_force_(half_of(body_force<Real>(force))),
        finder_(lattice, next),
        slots_(finder_.slots(0, 0)) {
    move_to_row(0);
  }

  /// @param velocity 3 numbers, overwritten
  void read(std::int64_t node, double* velocity, double* mobility) {
    if (node < pack_begin_ || node >= pack_end_) move_to_pack(node);
    const std::int64_t lane = node - pack_begin_;
    for (int component = 0; component < 3; ++component) velocity[component] = velocity_[component][lane];
    *mobility = mobility_[lane];
  }

 private:
  static constexpr int size = pack_size<Real>;

  static PackForce<Real> half_of(const PackForce<Real>& force) {
    return {Real(0.5) * force.x, Real(0.5) * force.y, Real(0.5) * force.z};
  }

  void move_to_pack(std::int64_t node) {
    if (node / nx_ != row_) move_to_row(node / nx_);
    const std::int64_t row_begin = row_ * nx_;
    const int x = static_cast<int>(node - row_begin) / size * size;
    pack_begin_ = row_begin + x;
    pack_end_ = std::min(pack_begin_ + size, row_begin + nx_);
    PackPopulations<Real> incoming;
    if (x == 0 || x + size >= nx_) {
      typename EndPack<Real>::Leaving nothing;
      EndPack<Real>(slots_, x, nx_, nothing).load_to(incoming);
    } else {
      WholePack<Real>{slots_, x}.load_to(incoming);
    }
    if (meets_moving_wall_) add_wall_gains(incoming, x);
    take(incoming);
  }

  void move_to_row(std::int64_t row) {
    const int ny = lattice_.shape().ny;
    row_ = row;
    y_ = static_cast<int>(row % ny);
    z_ = static_cast<int>(row / ny);
    slots_ = finder_.slots(y_, z_);
    meets_moving_wall_ = false;
    for (int i = 1; i < d3q19::n_directions; ++i) {
      if (lattice_.wall_gain(i) != 0 && (walls_across_rows() || lattice_.from_wall(i, 0, y_, z_)))
        meets_moving_wall_ = true;
    }
  }

  bool walls_across_rows() const { return lattice_.walls() && lattice_.walls()->axis == 0; }

  /// What RowSweep adds in the lattice just before it reads the row, added to what was read.
  void add_wall_gains(PackPopulations<Real>& incoming, int x) const {
    for (int i = 1; i < d3q19::n_directions; ++i) {
      const Real gain = lattice_.wall_gain(i);
      if (gain == 0) continue;
      if (walls_across_rows()) {
        for (const int end : {0, nx_ - 1}) {
          if (end >= x && end < x + size && lattice_.from_wall(i, end, y_, z_)) incoming[i][end - x] += gain;
        }
      } else if (lattice_.from_wall(i, 0, y_, z_)) {
        incoming[i] += pack_of(gain);
      }
    }
  }

  void take(const PackPopulations<Real>& incoming) {
    auto inverse_density = pack_of(Real(1));
    if (inertia_) inverse_density /= Real(1) + sum_of<Real>(incoming);
    mobility_ = Real(0.5) * inverse_density;
    const auto momentum = momentum_of<Real>(incoming);
    velocity_[0] = (momentum[0] + half_body_force_.x) * inverse_density;
    velocity_[1] = (momentum[1] + half_body_force_.y) * inverse_density;
    velocity_[2] = (momentum[2] + half_body_force_.z) * inverse_density;
  }

  const PopulationLattice<Real>& lattice_;
  int nx_;
  bool inertia_;
  PackForce<Real> half_body_force_;
  SlotFinder<Real> finder_;
  std::int64_t row_ = 0;
  int y_ = 0, z_ = 0;
  RowSlots<Real> slots_;
  bool meets_moving_wall_ = false;              ///< somewhere in the row
  std::int64_t pack_begin_ = 0, pack_end_ = 0;  ///< nodes of the pack that was read last; at first none
  std::array<Pack<Real>, 3> velocity_{};        ///< of that pack
  Pack<Real> mobility_{};
};

}  // namespace tanktread::fluid
