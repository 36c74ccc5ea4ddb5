// What the next step meets on a node, read from the populations that will come in. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fluid/collision.hpp"
#include "fluid/force_field.hpp"
#include "fluid/incoming_packs.hpp"
#include "fluid/pack_forces.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Reads velocity and mobility (Fluid::free_velocity) of one node after the other, by the packs and the sums
/// of the step itself. Nodes of a pack share its look-up, so each thread has a reader of its own; what it
/// finds does not depend on what was asked before. Lattice and forces are borrowed and must outlive it.
template <typename Real>
class IncomingReader {
 public:
  /// @param force of which only the body force counts
  /// @param next the kind of the step that will be done next
  IncomingReader(const PopulationLattice<Real>& lattice, const ForceField& force, Turn next, bool inertia)
      : nx_(lattice.shape().nx),
        inertia_(inertia),
        half_body_force_(half_of(body_force<Real>(force))),
        packs_(lattice, next) {}

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
    const std::int64_t row = node / nx_;
    const int x = static_cast<int>(node % nx_) / size * size;
    pack_begin_ = row * nx_ + x;
    pack_end_ = std::min(pack_begin_ + size, (row + 1) * nx_);
    PackPopulations<Real> incoming;
    packs_.load(row, x, incoming);
    take(incoming);
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

  std::int64_t nx_;
  bool inertia_;
  PackForce<Real> half_body_force_;
  IncomingPacks<Real> packs_;
  std::int64_t pack_begin_ = 0, pack_end_ = 0;  ///< nodes of the pack that was read last; at first none
  std::array<Pack<Real>, 3> velocity_{};        ///< of that pack
  Pack<Real> mobility_{};
};

}  // namespace tanktread::fluid
