// A closed surface of triangles whose nodes move: its measures, and the forces of an energy that depends on
// them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "membrane/mesh.hpp"
#include "membrane/surface_measures.hpp"
#include "membrane/triangle_lanes.hpp"

namespace tanktread::membrane {

struct SurfaceEdges;

/// It keeps the triangles and what its last measure() found. No result depends on the number of threads, to
/// the last bit; calls allocate nothing. One caller at a time.
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
  /// discrete energy, to rounding, at the positions of the last measure().
  /// @param derivatives entries as those of measures(); node_area and node_curvature are not looked at after
  /// a measure() without curvature
  /// @param force 3 x n_nodes
  /// @throws std::invalid_argument if the number of columns is not that of the nodes
  void add_forces(const MeasureDerivatives& derivatives, Eigen::Ref<Eigen::Matrix3Xd> force);

  // measure() and add_forces() in parts, for a caller that shares out the work of several surfaces
  // (advance()). In this order; of the blocks of a part, and of its nodes, several threads may work on
  // different ones.

  int n_triangle_blocks() const { return static_cast<int>(triangle_indices_.size()); }
  int n_edge_blocks() const { return static_cast<int>(edge_indices_.size()); }
  /// Parts of measure(); edges and nodes are of the curvature. @param positions 3 x n_nodes
  void measure_triangles(const Eigen::Matrix3Xd& positions, int block);
  void measure_edges(int block);
  void measure_nodes(int begin, int end);
  /// Ends it: area and volume. @param with_curvature whether edges and nodes were measured
  const SurfaceMeasures& add_up(bool with_curvature);
  /// The part of add_forces() on the corners of a block of triangles.
  void find_corner_forces(const MeasureDerivatives& derivatives, int block);
  /// The sum over the corners of a node.
  Eigen::Vector3d node_force(Eigen::Index node) const {
    double x = 0, y = 0, z = 0;
    for (int k = first_meeting_[node]; k < first_meeting_[node + 1]; ++k) {
      const double* force = corner_forces_.data() + meetings_[k].corner_force;
      x += force[0];
      y += force[n_lanes];
      z += force[2 * n_lanes];
    }
    return {x, y, z};
  }

  int n_nodes() const { return static_cast<int>(measures_.node_area.size()); }
  int n_triangles() const { return static_cast<int>(triangles_.cols()); }
  int n_edges() const { return n_edges_; }
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }

 private:
  /// What the triangles of a block have: nodes of the corners, where these are among the positions, and the
  /// edge opposite to each.
  struct TriangleIndices {
    IndexLanes node[3], position[3], edge[3];
  };
  /// What the edges of a block have, by offsets in shapes_: themselves as a side of their left triangle, and
  /// the normals of both triangles.
  struct EdgeIndices {
    IndexLanes side, left, right;
  };
  /// What comes to a node with one of its corners. Each edge of a node is the side from it of just one
  /// triangle.
  struct Meeting {
    int triangle, edge;
    int corner_force;  ///< offset in corner_forces_
  };
  /// Rows of shapes_. Edge k is opposite to corner k, from corner k + 1 to corner k + 2.
  enum ShapeRow { edge_row = 0, normal_row = 9, area_row = 12, n_shape_rows };

  void index(const SurfaceEdges& edges);
  void require_column_per_node(const std::string& what, Eigen::Index n_columns) const;

  int n_threads_;
  Eigen::Matrix3Xi triangles_;
  int n_edges_ = 0;
  std::vector<TriangleIndices> triangle_indices_;
  std::vector<EdgeIndices> edge_indices_;
  std::vector<Meeting> meetings_;   ///< of a node in the order of its corners
  std::vector<int> first_meeting_;  ///< of a node; n_nodes + 1 entries
  SurfaceMeasures measures_;
  bool with_curvature_ = true;
  LaneTable<n_shape_rows> shapes_;             ///< three edges, unit normal and area of each triangle
  Eigen::VectorXd block_area_, block_volume_;  ///< sums over blocks of triangles
  Eigen::VectorXd length_angle_;               ///< length times angle of each edge, whole blocks
  Eigen::VectorXd angle_by_length_;            ///< angle over length of each edge, whole blocks
  LaneTable<9> corner_forces_;                 ///< of each triangle, three corners
};

}  // namespace tanktread::membrane
