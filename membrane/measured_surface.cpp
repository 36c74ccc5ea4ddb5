#include "membrane/measured_surface.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "membrane/corners_of_node.hpp"
#include "membrane/dihedral_angle.hpp"
#include "membrane/surface_edges.hpp"

namespace tanktread::membrane {
namespace {

const TriangleMesh& checked(const TriangleMesh& mesh, int threads) {
  std::string message;
  for (const auto& defect : defects(inspect(mesh))) message += (message.empty() ? "" : "; ") + defect;
  if (!message.empty()) throw std::invalid_argument("energy terms: " + message);
  if (threads < 0) {
    throw std::invalid_argument("energy terms: threads = " + std::to_string(threads) +
                                "; 0 (all) or more is needed");
  }
  return mesh;
}

}  // namespace

MeasuredSurface::MeasuredSurface(const TriangleMesh& mesh, int threads)
    : n_threads_(threads > 0 ? threads : omp_get_max_threads()),
      triangles_(checked(mesh, threads).triangles),
      triangle_indices_(n_lane_blocks(n_triangles())),
      shapes_(n_triangles()),
      block_area_(n_triangle_blocks()),
      block_volume_(n_triangle_blocks()),
      corner_forces_(n_triangles()) {
  measures_.triangle_area.resize(n_triangles());
  measures_.node_area.resize(mesh.points.cols());
  measures_.node_curvature.resize(mesh.points.cols());
  index(SurfaceEdges(triangles_));
  length_angle_.resize(n_edge_blocks() * n_lanes);
  angle_by_length_.resize(n_edge_blocks() * n_lanes);
  measure(mesh.points, true);
}

/// Where in the tables a block, or a node, finds what it reads.
void MeasuredSurface::index(const SurfaceEdges& edges) {
  n_edges_ = edges.size();
  for (int number = 0; number < n_triangle_blocks(); ++number) {
    const LaneBlock block(number, n_triangles());
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < n_lanes; ++i) {
        triangle_indices_[number].node[k][i] = triangles_(k, block.thing(i));
        triangle_indices_[number].position[k][i] = 3 * triangles_(k, block.thing(i));
        triangle_indices_[number].edge[k][i] = edges.of_side[3 * block.thing(i) + (k + 1) % 3];
      }
    }
  }
  edge_indices_.resize(n_lane_blocks(n_edges_));
  for (int number = 0; number < n_edge_blocks(); ++number) {
    const LaneBlock block(number, n_edges_);
    for (int i = 0; i < n_lanes; ++i) {
      const int edge = block.thing(i), left = edges.left[edge];
      int opposite = 0;  // corner
      while (triangle_indices_[left / n_lanes].edge[opposite][left % n_lanes] != edge) ++opposite;
      edge_indices_[number].side[i] = shapes_.offset_of(left, edge_row + 3 * opposite);
      edge_indices_[number].left[i] = shapes_.offset_of(left, normal_row);
      edge_indices_[number].right[i] = shapes_.offset_of(edges.right[edge], normal_row);
    }
  }
  const CornersOfNode corners(triangles_, n_nodes());
  first_meeting_ = {0};
  for (int node = 0; node < n_nodes(); ++node) {
    for (const auto corner : corners.of(node)) {
      const auto triangle = static_cast<int>(corner / 3), k = static_cast<int>(corner % 3);
      meetings_.push_back({triangle, edges.of_side[corner], corner_forces_.offset_of(triangle, 3 * k)});
    }
    first_meeting_.push_back(static_cast<int>(meetings_.size()));
  }
}

void MeasuredSurface::require_column_per_node(const std::string& what, Eigen::Index n_columns) const {
  if (n_columns != n_nodes()) {
    throw std::invalid_argument("energy terms: " + what + " has " + std::to_string(n_columns) +
                                " columns, must have one for each of the " + std::to_string(n_nodes()) +
                                " nodes");
  }
}

/// Edges, areas, normals and tetrahedra of a block of triangles. The volume is that of the tetrahedra from
/// one node of the surface, which keeps digits when it is far from the origin.
void MeasuredSurface::measure_triangles(const Eigen::Matrix3Xd& points, int number) {
  const double* positions = points.data();
  const auto apex = LaneVector::of_points(positions, 0);
  const auto& corners = triangle_indices_[number].position;
  double* edge[3];
  for (int k = 0; k < 3; ++k) edge[k] = shapes_.row(number, edge_row + 3 * k);
  double* normal = shapes_.row(number, normal_row);
  double* area = shapes_.row(number, area_row);
  Lanes areas, six_volumes;
  // No lane writes where another reads.
#pragma omp simd
  for (int i = 0; i < n_lanes; ++i) {
    const auto corner0 = LaneVector::of_points(positions, corners[0][i]);
    const auto corner1 = LaneVector::of_points(positions, corners[1][i]);
    const auto corner2 = LaneVector::of_points(positions, corners[2][i]);
    const LaneVector edge1 = corner0 - corner2, edge2 = corner1 - corner0;
    const LaneVector area_normal = edge1.cross(edge2);
    const double twice_area = std::sqrt(area_normal.dot(area_normal));
    areas[i] = area[i] = 0.5 * twice_area;
    six_volumes[i] = (corner0 - apex).dot(area_normal);
    (corner2 - corner1).put(edge[0], i);
    edge1.put(edge[1], i);
    edge2.put(edge[2], i);
    ((1.0 / twice_area) * area_normal).put(normal, i);
  }
  const LaneBlock block(number, n_triangles());
  std::copy_n(areas.begin(), block.size, measures_.triangle_area.data() + block.begin);
  block_area_[number] = sum_of(areas, block);
  block_volume_[number] = sum_of(six_volumes, block) / 6.0;
}

/// Angles of a block of edges: of the unit normals n (left) and m (right) and the unit vector e along the
/// edge, sin = (n x m).e and cos = n.m.
void MeasuredSurface::measure_edges(int number) {
  const double* shapes = shapes_.data();
  const auto& indices = edge_indices_[number];
  double* length_angle = length_angle_.data() + number * n_lanes;
  double* angle_by_length = angle_by_length_.data() + number * n_lanes;
#pragma omp simd
  for (int i = 0; i < n_lanes; ++i) {
    const auto edge = LaneVector::of_rows(shapes, indices.side[i]);
    const auto left = LaneVector::of_rows(shapes, indices.left[i]);
    const auto right = LaneVector::of_rows(shapes, indices.right[i]);
    const double length = std::sqrt(edge.dot(edge)), scale = 1.0 / length;
    const double angle = dihedral_angle(scale * edge.dot(left.cross(right)), left.dot(right));
    length_angle[i] = length * angle;
    angle_by_length[i] = scale * angle;
  }
}

void MeasuredSurface::measure_nodes(int begin, int end) {
  for (int node = begin; node < end; ++node) {
    double area = 0, length_angle = 0;
    for (int k = first_meeting_[node]; k < first_meeting_[node + 1]; ++k) {
      area += measures_.triangle_area[meetings_[k].triangle];
      length_angle += length_angle_[meetings_[k].edge];
    }
    measures_.node_area[node] = area / 3.0;
    measures_.node_curvature[node] = length_angle / 4.0;
  }
}

const SurfaceMeasures& MeasuredSurface::add_up(bool with_curvature) {
  with_curvature_ = with_curvature;
  measures_.area = measures_.volume = 0;
  for (Eigen::Index block = 0; block < block_area_.size(); ++block) {
    measures_.area += block_area_[block];
    measures_.volume += block_volume_[block];
  }
  return measures_;
}

const SurfaceMeasures& MeasuredSurface::measure(const Eigen::Matrix3Xd& positions, bool with_curvature) {
  require_column_per_node("the position array", positions.cols());
#pragma omp parallel num_threads(n_threads_)
  {
#pragma omp for schedule(static)
    for (int block = 0; block < n_triangle_blocks(); ++block) measure_triangles(positions, block);
    if (with_curvature) {
#pragma omp for schedule(static)
      for (int block = 0; block < n_edge_blocks(); ++block) measure_edges(block);
#pragma omp for schedule(static)
      for (int node = 0; node < n_nodes(); ++node) measure_nodes(node, node + 1);
    }
  }
  return add_up(with_curvature);
}

void MeasuredSurface::add_forces(const MeasureDerivatives& derivatives, Eigen::Ref<Eigen::Matrix3Xd> force) {
  require_column_per_node("the force array", force.cols());
#pragma omp parallel num_threads(n_threads_)
  {
#pragma omp for schedule(static)
    for (int block = 0; block < n_triangle_blocks(); ++block) find_corner_forces(derivatives, block);
#pragma omp for schedule(static)
    for (int node = 0; node < n_nodes(); ++node) force.col(node) += node_force(node);
  }
}

}  // namespace tanktread::membrane
