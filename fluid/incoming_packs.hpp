// The populations that the next step will find, pack by pack. Internal to fluid/.
#pragma once

#include <cstdint>

#include "fluid/collision.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/row_packs.hpp"

namespace tanktread::fluid {

/// Reads pack after pack as the step itself will, and changes nothing. Packs of a row share the look-up of
/// it, so each thread has a reader of its own; what it finds does not depend on what was asked before. The
/// lattice is borrowed and must outlive it. Rows are numbered z ny + y.
template <typename Real>
class IncomingPacks {
 public:
  /// @param next the kind of the step that will be done next
  IncomingPacks(const PopulationLattice<Real>& lattice, Turn next)
      : lattice_(lattice), nx_(lattice.shape().nx), finder_(lattice, next), slots_(finder_.slots(0, 0)) {
    move_to_row(0);
  }

  /// The pack that begins with node x of a row; lanes beyond the row are zero.
  void load(std::int64_t row, int x, PackPopulations<Real>& incoming) {
    if (row != row_) move_to_row(row);
    if (x == 0 || x + size >= nx_) {
      typename EndPack<Real>::Leaving nothing;
      EndPack<Real>(slots_, x, nx_, nothing).load_to(incoming);
    } else {
      WholePack<Real>{slots_, x}.load_to(incoming);
    }
    if (meets_moving_wall_) add_wall_gains(incoming, x);
  }

 private:
  static constexpr int size = pack_size<Real>;

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

  const PopulationLattice<Real>& lattice_;
  int nx_;
  SlotFinder<Real> finder_;
  std::int64_t row_ = 0;
  int y_ = 0, z_ = 0;
  RowSlots<Real> slots_;
  bool meets_moving_wall_ = false;  ///< somewhere in the row
};

}  // namespace tanktread::fluid
