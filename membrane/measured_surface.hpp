// A closed surface of triangles whose nodes move: its measures, and the forces of an energy that depends on
// them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "membrane/corners_of_node.hpp"
#include "membrane/mesh.hpp"
#include "membrane/surface_edges.hpp"
#include "membrane/surface_measures.hpp"

namespace tanktread::membrane {

/// It keeps the triangles and what its last measure() found. No result depends on the number of threads, to
/// the last bit; calls allocate nothing but, once, the scratch of add_forces(). One caller at a time.
class MeasuredSurface {
 public:
  /// Measures the points that it is given, curvature included.
  /// @param mesh one closed surface, as a membrane
  /// @param threads OpenMP threads, 0: all
  /// @throws std::invalid_argument if the mesh has no triangle, a triangle names a node that does not exist
  /// or a point is not finite (inspect()), if it has defects(), or threads is negative
  explicit MeasuredSurface(const TriangleMesh& mesh, int threads = 0);

  /// Measures the surface at these positions. Its triangles must have areas (Membrane::check_elements()),
  /// else results are not finite. An edge folds to an angle of at most pi; there its curvature jumps.
  /// @param positions 3 x n_nodes
  /// @param with_curvature false leaves node_area and node_curvature as they were
  /// @throws std::invalid_argument if the number of columns is not that of the nodes
  const SurfaceMeasures& measure(const Eigen::Matrix3Xd& positions, bool with_curvature);
  const SurfaceMeasures& measures() const { return measures_; }  ///< as of the last measure()

  /// Adds the forces -dE/dx of an energy with these derivatives by the measures, the exact ones of the
  /// discrete energy, to rounding.
  /// @param positions those of the last measure()
  /// @param derivatives entries as those of measures(); node_area and node_curvature are not looked at after
  /// a measure() without curvature
  /// @param force 3 x n_nodes
  /// @throws std::invalid_argument if a number of columns is not that of the nodes
  void add_forces(const Eigen::Matrix3Xd& positions, const MeasureDerivatives& derivatives,
                  Eigen::Ref<Eigen::Matrix3Xd> force);

  // measure() and add_forces() in parts, for a caller that shares out the work of several surfaces
  // (advance()). In this order; of the blocks of a part, and of its nodes, several threads may work on
  // different ones.

  int n_triangle_blocks() const;
  int n_edge_blocks() const;
  /// Parts of measure(); edges and nodes are of the curvature. @param positions 3 x n_nodes
  void measure_triangles(const Eigen::Matrix3Xd& positions, int block);
  void measure_edges(const Eigen::Matrix3Xd& positions, int block);
  void measure_node(int node);
  /// Ends it: area and volume. @param with_curvature whether edges and nodes were measured
  const SurfaceMeasures& add_up(bool with_curvature);
  /// The part of add_forces() on the corners of a block of triangles, added into `corner_force`, a column a
  /// corner.
  void add_corner_forces(const Eigen::Matrix3Xd& positions, const MeasureDerivatives& derivatives, int block,
                         Eigen::Matrix3Xd& corner_force) const;

  int n_nodes() const { return static_cast<int>(measures_.node_area.size()); }
  int n_triangles() const { return static_cast<int>(triangles_.cols()); }
  int n_edges() const { return edges_.size(); }
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }

 private:
  void require_column_per_node(const std::string& what, Eigen::Index n_columns) const;

  int n_threads_;
  Eigen::Matrix3Xi triangles_;
  SurfaceEdges edges_;
  CornersOfNode corners_of_node_;
  SurfaceMeasures measures_;
  bool with_curvature_ = true;
  Eigen::Matrix3Xd unit_normal_;               ///< a column a triangle
  Eigen::VectorXd block_area_, block_volume_;  ///< sums over blocks of triangles
  Eigen::VectorXd length_angle_;               ///< length times angle of each edge
  Eigen::VectorXd angle_by_length_;            ///< angle over length of each edge
  Eigen::Matrix3Xd corner_force_;              ///< scratch of add_forces(), a column a corner
};

}  // namespace tanktread::membrane
