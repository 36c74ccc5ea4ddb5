// The packs at the ends of a row, whose neighbours do not all lie side by side.
#pragma once

#include <algorithm>
#include <array>

#include "fluid/collision.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Where slot (i, x = 0) of a row lies, for each direction (PopulationLattice::row_slot).
using RowSlots = std::array<double*, d3q19::n_directions>;

/// A pack at an end of a row: some of its nodes reach round the box (or meet a wall across x), some may lie
/// beyond the row. Along the directions for which its slots lie side by side it is read and written whole,
/// else by lanes.
struct EndPack {
  EndPack(const PopulationLattice& lattice, Turn turn, const RowSlots& slots, int x, int y, int z)
      : n_lanes(std::min(pack_size, lattice.shape().nx - x)) {
    const int nx = lattice.shape().nx;
    for (int i = 0; i < d3q19::n_directions; ++i) {
      const int c = d3q19::velocity[i][0];
      const bool leaves = turn == Turn::streaming && ((c > 0 && x == 0) || (c < 0 && x + pack_size >= nx));
      whole[i] = n_lanes == pack_size && !leaves;
      address[i][0] = slots[i] + x;
      if (whole[i]) continue;
      for (int lane = 0; lane < n_lanes; ++lane) address[i][lane] = slots[i] + x + lane;
      if (leaves && c > 0) address[i][0] = lattice.slot(turn, i, 0, y, z);
      if (leaves && c < 0) address[i][n_lanes - 1] = lattice.slot(turn, i, nx - 1, y, z);
      // Lanes beyond the row repeat its last node: a result that is computed and dropped.
      for (int lane = n_lanes; lane < pack_size; ++lane) address[i][lane] = address[i][n_lanes - 1];
    }
  }

  void load_to(PackPopulations& f) const {
    for (int i = 0; i < d3q19::n_directions; ++i) {
      double* const* a = address[i];
      f[i] = whole[i] ? load(a[0]) : Pack{*a[0], *a[1], *a[2], *a[3], *a[4], *a[5], *a[6], *a[7]};
    }
  }

  void put(int i, Pack outgoing) const {
    if (whole[i]) {
      store(address[i][0], outgoing);
    } else {
      for (int lane = 0; lane < n_lanes; ++lane) *address[i][lane] = outgoing[lane];
    }
  }

  int n_lanes;
  bool whole[d3q19::n_directions];
  double* address[d3q19::n_directions][pack_size];
};

}  // namespace tanktread::fluid
