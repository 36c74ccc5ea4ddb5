// Where the populations of a pack lie in the rows of the lattice. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fluid/collision.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// The slots of a row of nodes, for each direction.
template <typename Real>
struct RowSlots {
  /// Slot (i, x = 0), as if the row went on at both ends (PopulationLattice::row_slot).
  std::array<Real*, d3q19::n_directions> at;
  /// Where the slot at an end of the row really lies, if it is not beside the others: that of x = 0 for a
  /// direction along +x, of x = nx - 1 for one along -x. Else null.
  std::array<Real*, d3q19::n_directions> beyond;
  /// The ends of the row are at walls.
  bool between_walls;

  RowSlots(const PopulationLattice<Real>& lattice, Turn turn, int y, int z)
      : beyond{}, between_walls(lattice.walls() && lattice.walls()->axis == 0) {
    for (int i = 0; i < d3q19::n_directions; ++i) {
      at[i] = lattice.row_slot(turn, i, y, z);
      const int c = d3q19::velocity[i][0];
      if (c == 0 || at[i] == lattice.row(i, y, z)) continue;
      const int end = c > 0 ? 0 : lattice.shape().nx - 1;
      Real* const place = lattice.slot(turn, i, end, y, z);
      if (place != at[i] + end) beyond[i] = place;  // else in the halo
    }
  }

  /// Those of the row that lies `distance` numbers further on in the memory, if both are within the box.
  RowSlots moved(std::int64_t distance) const {
    RowSlots slots = *this;
    for (auto& address : slots.at) address += distance;
    for (auto& address : slots.beyond) address += address ? distance : 0;
    return slots;
  }
};

/// Finds the slots of one row after the other. The lattice is borrowed.
template <typename Real>
class SlotFinder {
 public:
  SlotFinder(const PopulationLattice<Real>& lattice, Turn turn)
      : lattice_(lattice), turn_(turn), within_(lattice, turn, y_within(), z_within()) {}

  /// Rows whose neighbours all lie within the box look alike.
  RowSlots<Real> slots(int y, int z) const {
    const auto& shape = lattice_.shape();
    if (y < 1 || y >= shape.ny - 1 || z < 1 || z >= shape.nz - 1) return {lattice_, turn_, y, z};
    return within_.moved(lattice_.row(0, y, z) - lattice_.row(0, y_within(), z_within()));
  }

 private:
  int y_within() const { return std::min(1, lattice_.shape().ny - 1); }
  int z_within() const { return std::min(1, lattice_.shape().nz - 1); }

  const PopulationLattice<Real>& lattice_;
  Turn turn_;
  RowSlots<Real> within_;
};

/// A pack within a row: its slots lie side by side along every direction.
template <typename Real>
struct WholePack {
  static constexpr int n_lanes = pack_size<Real>;

  /// What comes in, before the collision.
  __attribute__((always_inline)) void load_to(PackPopulations<Real>& f) const {
#pragma GCC unroll 19
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = load(slots.at[i] + x);
  }
  /// Takes what collide() puts: what goes out along the opposite of i.
  __attribute__((always_inline)) void put(int i, Pack<Real> outgoing) const {
    store(slots.at[i] + x, outgoing);
  }

  const RowSlots<Real>& slots;
  int x;
};

/// A pack at an end of a row, or at both. Some of its nodes reach round the box (or meet a wall across x);
/// some of its lanes may lie beyond the row, in the padding of the lattice: they come in as zero.
///
/// What goes out to the other end of the row is held back until the whole row is done (`leave`): a pack with
/// lanes beyond the row writes there what counts for nothing.
template <typename Real>
class EndPack {
 public:
  /// What went out across an end of the row, to go to RowSlots::beyond.
  using Leaving = std::array<Real, d3q19::n_directions>;

  /// Slots and `leaving` must outlive this.
  EndPack(const RowSlots<Real>& slots, int x, int nx, Leaving& leaving)
      : n_lanes(std::min(pack_size<Real>, nx - x)),
        slots_(slots),
        x_(x),
        first_(x == 0),
        last_(x + pack_size<Real> >= nx),
        leaving_(leaving) {}

  __attribute__((always_inline)) void load_to(PackPopulations<Real>& f) const {
#pragma GCC unroll 19
    for (int i = 0; i < d3q19::n_directions; ++i) {
      const Real* at = slots_.at[i] + x_;
      if (leaves_low(i)) {
        f[i] = moved_up(load(at + 1), *slots_.beyond[i]);
      } else if (leaves_high(i)) {
        f[i] = moved_down(load(at - 1));
        f[i][n_lanes - 1] = *slots_.beyond[i];
      } else {
        f[i] = load(at);
      }
    }
    if (n_lanes == pack_size<Real>) return;
#pragma GCC unroll 19
    for (int i = 0; i < d3q19::n_directions; ++i) f[i] = first_lanes(f[i], n_lanes);
  }

  __attribute__((always_inline)) void put(int i, Pack<Real> outgoing) const {
    Real* at = slots_.at[i] + x_;
    if (leaves_low(i)) {
      leaving_[i] = outgoing[0];
      if (spares_next(i)) {
        store_lanes(at, outgoing, 1, n_lanes);
      } else {
        store_all_but_last(at + 1, moved_down(outgoing));
      }
    } else if (leaves_high(i)) {
      leaving_[i] = outgoing[n_lanes - 1];
      store_all_but_last(at, outgoing);
    } else if (spares_next(i)) {
      store_lanes(at, outgoing, 0, n_lanes);
    } else {
      store(at, outgoing);
    }
  }

  /// At the end of a row: brings what went out across its ends to its place.
  static void leave(const RowSlots<Real>& slots, const Leaving& leaving) {
    for (int i = 0; i < d3q19::n_directions; ++i)
      if (slots.beyond[i]) *slots.beyond[i] = leaving[i];
  }

  const int n_lanes;

 private:
  bool leaves_low(int i) const {
    return first_ && d3q19::velocity[i][0] > 0 && slots_.beyond[i];
  }
  bool leaves_high(int i) const {
    return last_ && d3q19::velocity[i][0] < 0 && slots_.beyond[i];
  }
  /// Between walls across x the last slots of a row along +x have one of another row behind them.
  bool spares_next(int i) const {
    return d3q19::velocity[i][0] > 0 && slots_.between_walls && n_lanes < pack_size<Real>;
  }

  const RowSlots<Real>& slots_;
  int x_;
  bool first_, last_;
  Leaving& leaving_;
};

}  // namespace tanktread::fluid
