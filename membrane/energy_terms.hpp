// The energies of one membrane besides its elastic law: a list of terms, their energies and their forces.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "membrane/energy_term.hpp"
#include "membrane/measured_surface.hpp"
#include "membrane/triangle_lanes.hpp"

namespace tanktread::membrane {

/// A term by its name in energy_term_table(), and what it takes.
struct EnergyChoice {
  std::string name;
  EnergyParameters parameters;
};

/// Energies of a closed surface. Units are those of the points and of the parameters. The surface is measured
/// once, and goes from derivatives to nodal forces once, for all terms together. No result depends on the
/// number of threads, to the last bit; calls allocate nothing but what they return. One caller at a time.
class EnergyTerms {
 public:
  /// @param reference its areas and its volume are those at rest, unless the parameters say otherwise
  /// @param choices any number, each term once at most
  /// @param threads OpenMP threads, 0: all
  /// @throws std::invalid_argument for a mesh or a number of threads as MeasuredSurface, for a name or
  /// parameters as make_energy_term(), for a term that is named twice
  EnergyTerms(const TriangleMesh& reference, const std::vector<EnergyChoice>& choices, int threads = 0);

  std::size_t size() const { return terms_.size(); }
  const std::string& name(std::size_t k) const { return names_.at(k); }

  /// The energy of each term, in the order of the choices.
  /// @param positions 3 x n_nodes
  /// @throws std::invalid_argument if the number of columns is not that of the nodes
  std::vector<double> energies(const Eigen::Matrix3Xd& positions);
  /// Their sum.
  double energy(const Eigen::Matrix3Xd& positions);

  /// Adds the total nodal forces -dE/dx of all terms into `force`, which the caller clears.
  /// @throws std::invalid_argument if a number of columns is not that of the nodes
  void add_forces(const Eigen::Matrix3Xd& positions, Eigen::Ref<Eigen::Matrix3Xd> force);
  /// The same of one term, for output. @throws std::out_of_range unless k < size()
  void add_forces_of(std::size_t k, const Eigen::Matrix3Xd& positions, Eigen::Ref<Eigen::Matrix3Xd> force);

  const Eigen::Matrix3Xi& triangles() const { return surface_.triangles(); }
  int n_nodes() const { return surface_.n_nodes(); }

  // The work of add_forces() in parts, for a caller that shares out that of several membranes (advance()). In
  // this order; of the blocks of a part, and of its nodes, several threads may work on different ones. Blocks
  // are of `block_size` triangles.

  static constexpr int block_size = n_lanes;
  int n_blocks() const { return surface_.n_triangle_blocks(); }
  int n_edge_blocks() const { return any_depends_on_curvature_ ? surface_.n_edge_blocks() : 0; }
  void measure_block(const Eigen::Matrix3Xd& positions, int block) {
    surface_.measure_triangles(positions, block);
  }
  void measure_edges(int block) { surface_.measure_edges(block); }
  void measure_nodes(int begin, int end) {
    if (any_depends_on_curvature_) surface_.measure_nodes(begin, end);
  }
  /// All together: the derivatives of the terms.
  void derive();
  /// The forces on the corners of a block of triangles, and their sum at a node.
  void find_corner_forces(int block) { surface_.find_corner_forces(derivatives_, block); }
  Eigen::Vector3d node_force(Eigen::Index node) const { return surface_.node_force(node); }

 private:
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<EnergyTerm>> terms_;
  MeasuredSurface surface_;
  MeasureDerivatives derivatives_;  ///< scratch
  bool any_depends_on_curvature_ = false;
};

}  // namespace tanktread::membrane
