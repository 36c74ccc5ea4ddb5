// Density and velocity of a node, read from the populations that the last step left. Internal to fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "fluid/end_pack.hpp"
#include "fluid/force_field.hpp"
#include "fluid/population_lattice.hpp"

namespace tanktread::fluid {

struct NodeMoments {
  double density;
  std::array<double, 3> velocity;
};

/// Reads one node after the other. Nodes that follow each other in a row share the look-up of its slots, so
/// each thread has a reader of its own. Lattice and forces are borrowed and must outlive it.
class MomentReader {
 public:
  /// @param last the kind of the step that was done last
  MomentReader(const PopulationLattice& lattice, const ForceField& force, Turn last, bool inertia)
      : lattice_(lattice), force_(force), last_(last), inertia_(inertia) {}

  /// A collision adds the force F to the momentum sum f c, so that with outgoing populations u = (sum f c -
  /// F/2)/rho.
  NodeMoments at(std::int64_t node) {
    const auto n_row = std::int64_t{lattice_.shape().nx};
    if (node < row_begin_ || node >= row_begin_ + n_row) move_to_row(node / n_row);
    const std::int64_t x = node - row_begin_;
    double f[d3q19::n_directions];
    if (x > 0 && x < n_row - 1) {
      for (int i = 0; i < d3q19::n_directions; ++i) f[i] = slots_[d3q19::opposite(i)][x];
    } else {
      lattice_.get_outgoing(last_, static_cast<int>(x), y_, z_, f);
    }
    double density_change = f[0];
    for (int i = 1; i < d3q19::n_directions; ++i) density_change += f[i];
    NodeMoments moments{1.0 + density_change, {}};
    const auto force = force_.total(node);
    for (int component = 0; component < 3; ++component) {
      double momentum = 0.0;
      for (int i = 1; i < d3q19::n_directions; i += 2)
        momentum += d3q19::velocity[i][component] * (f[i] - f[i + 1]);
      momentum -= 0.5 * force[component];
      moments.velocity[component] = inertia_ ? momentum / moments.density : momentum;
    }
    return moments;
  }

 private:
  void move_to_row(std::int64_t row) {
    const int ny = lattice_.shape().ny;
    row_begin_ = row * lattice_.shape().nx;
    y_ = static_cast<int>(row % ny);
    z_ = static_cast<int>(row / ny);
    for (int i = 0; i < d3q19::n_directions; ++i) slots_[i] = lattice_.row_slot(last_, i, y_, z_);
  }

  const PopulationLattice& lattice_;
  const ForceField& force_;
  Turn last_;
  bool inertia_;
  std::int64_t row_begin_ = std::numeric_limits<std::int32_t>::min();  ///< first node; at first of no row
  int y_ = 0, z_ = 0;
  RowSlots slots_{};  ///< right away from the ends of the row
};

}  // namespace tanktread::fluid
