// A step of one row of nodes: stream, collide, bring away. Internal to fluid/.
#pragma once

#include <algorithm>
#include <cstdint>

#include "fluid/collision.hpp"
#include "fluid/force_field.hpp"
#include "fluid/kept_velocity.hpp"
#include "fluid/node_moments.hpp"
#include "fluid/node_rates.hpp"
#include "fluid/pack_forces.hpp"
#include "fluid/population_lattice.hpp"
#include "fluid/row_packs.hpp"

namespace tanktread::fluid {

/// What a step needs of a solver; all is borrowed and must outlive the sweep.
template <typename Real>
struct SweepParts {
  PopulationLattice<Real>& lattice;
  const NodeRates<Real>& rates;
  const ForceField& force;
  KeptVelocity<Real>& kept_velocity;
  Real limit_squared;  ///< of the speed
};

/// Advances rows, each by one thread; rows may be advanced in any order.
template <typename Real, bool inertia>
class RowSweep {
 public:
  RowSweep(const SweepParts<Real>& parts, Turn turn)
      : parts_(parts), turn_(turn), nx_(parts.lattice.shape().nx), finder_(parts.lattice, turn) {}

  void advance(int y, int z, SpeedWatch<Real>& watch) const {
    const std::int64_t row = std::int64_t{z} * parts_.lattice.shape().ny + y;
    if (parts_.lattice.walls()) return_from_walls(y, z);
    const RowSlots<Real> slots = finder_.slots(y, z);
    if (parts_.force.may_act_in(row)) {
      advance_packs<true>(slots, row, watch);
    } else {
      advance_packs<false>(slots, row, watch);
    }
  }

 private:
  static constexpr int size = pack_size<Real>;

  /// @tparam may_have_force forces are looked for, pack by pack
  template <bool may_have_force>
  void advance_packs(const RowSlots<Real>& slots, std::int64_t row, SpeedWatch<Real>& watch) const {
    typename EndPack<Real>::Leaving leaving;
    const bool ends_reach_round = turn_ == Turn::streaming;
    for (int x = 0; x < nx_; x += size) {
      const bool at_end = x + size > nx_ || (ends_reach_round && (x == 0 || x + size == nx_));
      const bool added = may_have_force && added_to(row, x);
      const bool forced = may_have_force && (added || parts_.force.has_body_force());
      if (at_end) {
        advance_end(EndPack<Real>(slots, x, nx_, leaving), row, x, forced, added, watch);
      } else if (forced) {
        push(WholePack<Real>{slots, x}, row, x, added, watch);
      } else {
        collide_at(WholePack<Real>{slots, x}, row, x, watch);
      }
    }
    if (ends_reach_round) EndPack<Real>::leave(slots, leaving);
  }

  /// A force other than zero was added to a node of the pack.
  bool added_to(std::int64_t row, int x) const {
    const int n = std::min(size, nx_ - x);
    if (!parts_.force.may_be_added_to(row, x, n)) return false;
    const double* added = parts_.force.added_to(row * nx_ + x);
    return n == size ? any_force(added, 3 * size) : any_force(added, 3 * n);  // the first is without a loop
  }

  // Two kinds of pack are kept out of the loop over whole packs without a force, whose code stays small that
  // way.

  __attribute__((noinline)) void advance_end(const EndPack<Real>& at, std::int64_t row, int x, bool forced,
                                             bool added, SpeedWatch<Real>& watch) const {
    if (forced) return push(at, row, x, added, watch);
    collide_at(at, row, x, watch);
  }

  /// Collides a pack with a force, and keeps its velocity if the force was added.
  template <typename SomePack>
  __attribute__((noinline)) void push(const SomePack& at, std::int64_t row, int x, bool added,
                                      SpeedWatch<Real>& watch) const {
    auto force =
        added ? total_force<Real>(parts_.force, row * nx_ + x, at.n_lanes) : body_force<Real>(parts_.force);
    // A lane beyond the row would count as a node that the force moves.
    if (at.n_lanes < size) force = first_lanes(force, at.n_lanes);
    PackPopulations<Real> incoming;
    OutgoingMoments<Real, Pack<Real>> outgoing;  // collide() puts in the order that it needs
    at.load_to(incoming);
    collide<inertia, true, Real>(
        incoming, parts_.rates.pack(row, x), force, parts_.limit_squared,
        watch, [&](int i, Pack<Real> pack) __attribute__((always_inline)) {
          at.put(i, pack);
          outgoing.take(d3q19::opposite(i), pack);
        });
    if (!added) return;
    parts_.kept_velocity.put(row, x, outgoing.moments({force.x, force.y, force.z}, inertia).velocity);
  }

  template <typename SomePack>
  __attribute__((always_inline)) void collide_at(const SomePack& at, std::int64_t row, int x,
                                                 SpeedWatch<Real>& watch) const {
    PackPopulations<Real> incoming;
    at.load_to(incoming);
    collide<inertia, false, Real>(
        incoming, parts_.rates.pack(row, x), PackForce<Real>{}, parts_.limit_squared,
        watch, [&](int i, Pack<Real> pack) __attribute__((always_inline)) { at.put(i, pack); });
  }

  /// What moving walls give to the populations they send back, added where the step will find these.
  void return_from_walls(int y, int z) const {
    auto& lattice = parts_.lattice;
    const bool across_rows = lattice.walls()->axis == 0;
    for (int i = 1; i < d3q19::n_directions; ++i) {
      const Real gain = lattice.wall_gain(i);
      if (gain == 0) continue;
      if (across_rows) {
        for (const int x : {0, nx_ - 1}) {
          if (lattice.from_wall(i, x, y, z)) *lattice.slot(turn_, i, x, y, z) += gain;
        }
      } else if (lattice.from_wall(i, 0, y, z)) {
        Real* slots = lattice.row(i, y, z);
        for (int x = 0; x < nx_; ++x) slots[x] += gain;
      }
    }
  }

  SweepParts<Real> parts_;
  Turn turn_;
  int nx_;
  SlotFinder<Real> finder_;
};

}  // namespace tanktread::fluid
