// Where the populations of a pack lie: side by side within a row, not all of them at its ends. Internal to
// fluid/.
#pragma once

#include <algorithm>
#include <array>

#include "fluid/collision.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Where slot (i, x = 0) of a row lies, for each direction (PopulationLattice::row_slot).
using RowSlots = std::array<double*, d3q19::n_directions>;

/// A pack within a row, whose slots lie side by side along every direction.
struct WholePack {
  int n_lanes() const { return pack_size; }

  /// What comes in, before the collision.
  void load_to(PackPopulations& f) const {
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = load(slots[i] + x);
  }
  /// Takes what collide() puts: what goes out along the opposite of i.
  void put(int i, Pack outgoing) const { store(slots[i] + x, outgoing); }
  /// After the collision: what went out along i.
  void load_outgoing(PackPopulations& f) const {
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = load(slots[d3q19::opposite(i)] + x);
  }

  const RowSlots& slots;
  int x;
};

/// A pack at an end of a row: some of its nodes reach round the box (or meet a wall across x), some may lie
/// beyond the row. Along the directions for which its slots lie side by side it is read and written whole,
/// else by lanes.
class EndPack {
 public:
  EndPack(const PopulationLattice& lattice, Turn turn, const RowSlots& slots, int x, int y, int z)
      : n_lanes_(std::min(pack_size, lattice.shape().nx - x)) {
    const int nx = lattice.shape().nx;
    for (int i = 0; i < d3q19::n_directions; ++i) {
      const int c = d3q19::velocity[i][0];
      const bool leaves = turn == Turn::streaming && ((c > 0 && x == 0) || (c < 0 && x + pack_size >= nx));
      whole_[i] = n_lanes_ == pack_size && !leaves;
      address_[i][0] = slots[i] + x;
      if (whole_[i]) continue;
      for (int lane = 0; lane < n_lanes_; ++lane) address_[i][lane] = slots[i] + x + lane;
      if (leaves && c > 0) address_[i][0] = lattice.slot(turn, i, 0, y, z);
      if (leaves && c < 0) address_[i][n_lanes_ - 1] = lattice.slot(turn, i, nx - 1, y, z);
      // Lanes beyond the row repeat its last node: a result that is computed and dropped.
      for (int lane = n_lanes_; lane < pack_size; ++lane) address_[i][lane] = address_[i][n_lanes_ - 1];
    }
  }

  int n_lanes() const { return n_lanes_; }

  void load_to(PackPopulations& f) const {
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = get(i);
  }

  void put(int i, Pack outgoing) const {
    if (whole_[i]) {
      store(address_[i][0], outgoing);
    } else {
      for (int lane = 0; lane < n_lanes_; ++lane) *address_[i][lane] = outgoing[lane];
    }
  }

  void load_outgoing(PackPopulations& f) const {
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = get(d3q19::opposite(i));
  }

 private:
  Pack get(int i) const {
    double* const* a = address_[i];
    return whole_[i] ? load(a[0]) : Pack{*a[0], *a[1], *a[2], *a[3], *a[4], *a[5], *a[6], *a[7]};
  }

  int n_lanes_;
  bool whole_[d3q19::n_directions];
  double* address_[d3q19::n_directions][pack_size];
};

}  // namespace tanktread::fluid
