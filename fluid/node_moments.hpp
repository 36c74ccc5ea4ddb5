// Density and velocity of a node, read from the populations that the last step left. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "fluid/force_field.hpp"
#include "fluid/kept_velocity.hpp"
#include "fluid/pack.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

/// Density and velocity of one node, or of the nodes of a pack (Number = Pack<Real>).
template <typename Number>
struct Moments {
  Number density;
  std::array<Number, 3> velocity;
};

/// The moments that a collision met, from what goes out of it along each direction. A collision adds the
/// force F to the momentum sum f c, so that with outgoing populations u = (sum f c - F/2)/rho.
///
/// Node and pack agree to the last bit: the sums are the same, in the same order. @tparam Real of the lattice
/// @tparam Number Real, or Pack<Real>
template <typename Real, typename Number>
class OutgoingMoments {
 public:
  /// Takes what goes out along direction i; all directions, in their order.
  __attribute__((always_inline)) void take(int i, Number f) {
    density_change_ = i == 0 ? f : density_change_ + f;
    if (i % 2 == 1) first_ = f;
    if (i == 0 || i % 2 == 1) return;
    const auto& c = d3q19::velocity[i - 1];
#pragma GCC unroll 3
    for (int component = 0; component < 3; ++component) {
      if (c[component] != 0) momentum_[component] += Real(c[component]) * (first_ - f);
    }
  }

  /// After all have been taken.
  Moments<Number> moments(const std::array<Number, 3>& force, bool inertia) const {
    Moments<Number> moments{Real(1) + density_change_, {}};
    for (int component = 0; component < 3; ++component) {
      const Number momentum = momentum_[component] - Real(0.5) * force[component];
      moments.velocity[component] = inertia ? momentum / moments.density : momentum;
    }
    return moments;
  }

 private:
  Number density_change_{}, first_{};
  std::array<Number, 3> momentum_{};
};

/// Reads one node after the other. Nodes that follow each other in a row share the look-up of its slots, so
/// each thread has a reader of its own. Lattice, forces and kept velocities are borrowed and must outlive it.
template <typename Real>
class MomentReader {
 public:
  /// @param last the kind of the step that was done last
  MomentReader(const PopulationLattice<Real>& lattice, const ForceField& force,
               const KeptVelocity<Real>& kept, Turn last, bool inertia)
      : lattice_(lattice), force_(force), kept_(kept), last_(last), inertia_(inertia) {}

  Moments<double> at(std::int64_t node) {
    if (!holds(node)) move_to_row(node / lattice_.shape().nx);
    const std::int64_t x = node - row_begin_;
    Real f[d3q19::n_directions];
    if (x > 0 && x < lattice_.shape().nx - 1) {
      for (int i = 0; i < d3q19::n_directions; ++i) f[i] = slots_[d3q19::opposite(i)][x];
    } else {
      lattice_.get_outgoing(last_, static_cast<int>(x), y_, z_, f);
    }
    const auto force = force_.total(node);
    OutgoingMoments<Real, Real> outgoing;
    for (int i = 0; i < d3q19::n_directions; ++i) outgoing.take(i, f[i]);
    const auto moments = outgoing.moments({Real(force[0]), Real(force[1]), Real(force[2])}, inertia_);
    return {moments.density, {moments.velocity[0], moments.velocity[1], moments.velocity[2]}};
  }

  /// The velocity of a node: the kept one, if there is one.
  void velocity_at(std::int64_t node, double* velocity) {
    if (node < pack_begin_ || node >= pack_end_) move_to_pack(node);
    if (!kept_pack_) {
      std::copy_n(at(node).velocity.data(), 3, velocity);
      return;
    }
    for (int component = 0; component < 3; ++component)
      velocity[component] = kept_pack_[component * pack_size<Real> + (node - pack_begin_)];
  }

 private:
  bool holds(std::int64_t node) const {
    return node >= row_begin_ && node < row_begin_ + lattice_.shape().nx;
  }

  void move_to_pack(std::int64_t node) {
    if (!holds(node)) move_to_row(node / lattice_.shape().nx);
    const std::int64_t x = node - row_begin_;
    pack_begin_ = node - x % pack_size<Real>;
    pack_end_ = std::min<std::int64_t>(pack_begin_ + pack_size<Real>, row_begin_ + lattice_.shape().nx);
    kept_pack_ = kept_.find(row_, x);
  }

  void move_to_row(std::int64_t row) {
    const int ny = lattice_.shape().ny;
    row_ = row;
    row_begin_ = row * lattice_.shape().nx;
    y_ = static_cast<int>(row % ny);
    z_ = static_cast<int>(row / ny);
    for (int i = 0; i < d3q19::n_directions; ++i) slots_[i] = lattice_.row_slot(last_, i, y_, z_);
  }

  const PopulationLattice<Real>& lattice_;
  const ForceField& force_;
  const KeptVelocity<Real>& kept_;
  Turn last_;
  bool inertia_;
  std::int64_t row_ = 0;
  std::int64_t row_begin_ = std::numeric_limits<std::int32_t>::min();  ///< first node; at first of no row
  int y_ = 0, z_ = 0;
  std::int64_t pack_begin_ = 0, pack_end_ = 0;  ///< nodes of the pack that was looked up last; at first none
  const Real* kept_pack_ = nullptr;             ///< its velocities, if they were kept
  std::array<Real*, d3q19::n_directions> slots_{};  ///< right away from the ends of the row
};

}  // namespace tanktread::fluid
