#include "membrane/measured_surface.hpp"

#include <omp.h>

#include <cmath>
#include <stdexcept>

#include "membrane/dihedral_angle.hpp"
#include "membrane/triangle_lanes.hpp"

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

/// Edge k of a triangle is opposite to its corner k, from corner k + 1 to corner k + 2.
struct TriangleLanes {
  VectorLanes edge[3];
  VectorLanes normal;  ///< unit
  Lanes area;
};

void subtract(const VectorLanes& a, const VectorLanes& b, VectorLanes& difference) {
  for (int i = 0; i < n_lanes; ++i) {
    difference.x[i] = a.x[i] - b.x[i];
    difference.y[i] = a.y[i] - b.y[i];
    difference.z[i] = a.z[i] - b.z[i];
  }
}

/// Corners of the triangles of a block. @param corners three
void load_corners(const double* positions, const int* triangles, const LaneBlock& block,
                  VectorLanes* corners) {
  for (int i = 0; i < n_lanes; ++i) {
    const int* nodes = triangles + 3 * block.thing(i);
    for (int k = 0; k < 3; ++k) corners[k].set(i, positions + 3 * nodes[k]);
  }
}

/// Forces of a tension and of a pressure inwards: the gradient of the area by corner k is (n x edge k)/2,
/// that of the volume by a node the sum of A n/3 over its triangles. @param forces of the three corners
void set_area_forces(const TriangleLanes& triangles, const Lanes& tension, double pressure,
                     VectorLanes* forces) {
  const auto& n = triangles.normal;
  const double third = pressure / 3.0;
  for (int k = 0; k < 3; ++k) {
    const auto& edge = triangles.edge[k];
    auto& force = forces[k];
    for (int i = 0; i < n_lanes; ++i) {
      const double half = 0.5 * tension[i], push = third * triangles.area[i];
      force.x[i] = -half * (n.y[i] * edge.z[i] - n.z[i] * edge.y[i]) - push * n.x[i];
      force.y[i] = -half * (n.z[i] * edge.x[i] - n.x[i] * edge.z[i]) - push * n.y[i];
      force.z[i] = -half * (n.x[i] * edge.y[i] - n.y[i] * edge.x[i]) - push * n.z[i];
    }
  }
}

/// What the derivatives by M_i are in the triangles of a block: those by length times angle of an edge are a
/// fourth of the sum over its two nodes.
struct CurvatureLanes {
  Lanes by_node[3];          ///< dE/dM_i of the corners
  Lanes angle_by_length[3];  ///< of edge k
};

/// Adds the forces of the curvature. With w = dE/d(length angle), l angle and its two parts:
/// - the gradient of the angle of an edge is along the normals; in a triangle the gradients l w d(angle) of
/// the
///   three edges add up to n times [(m_k - m_k+1) cot k+2 + (m_k - m_k+2) cot k+1]/4 at corner k, m =
///   dE/dM_i;
/// - the gradient of the length of edge k is its direction: w angle/length times the edge, half of it by
///   either of the two triangles.
void add_curvature_forces(const TriangleLanes& triangles, const CurvatureLanes& curvature,
                          VectorLanes* forces) {
  Lanes by_area, cotangent[3], pull[3];
  for (int i = 0; i < n_lanes; ++i) by_area[i] = -0.5 / triangles.area[i];
  for (int k = 0; k < 3; ++k) {
    const auto &a = triangles.edge[(k + 1) % 3], &b = triangles.edge[(k + 2) % 3];
    const auto &ma = curvature.by_node[(k + 1) % 3], &mb = curvature.by_node[(k + 2) % 3];
    for (int i = 0; i < n_lanes; ++i) {
      cotangent[k][i] = by_area[i] * (a.x[i] * b.x[i] + a.y[i] * b.y[i] + a.z[i] * b.z[i]);
      pull[k][i] = 0.125 * (ma[i] + mb[i]) * curvature.angle_by_length[k][i];
    }
  }
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const auto &in = triangles.edge[next], &out = triangles.edge[last];
    auto& force = forces[k];
    for (int i = 0; i < n_lanes; ++i) {
      const double m = curvature.by_node[k][i];
      const double push = 0.25 * ((m - curvature.by_node[next][i]) * cotangent[last][i] +
                                  (m - curvature.by_node[last][i]) * cotangent[next][i]);
      force.x[i] -= push * triangles.normal.x[i] + pull[next][i] * in.x[i] - pull[last][i] * out.x[i];
      force.y[i] -= push * triangles.normal.y[i] + pull[next][i] * in.y[i] - pull[last][i] * out.y[i];
      force.z[i] -= push * triangles.normal.z[i] + pull[next][i] * in.z[i] - pull[last][i] * out.z[i];
    }
  }
}

double sum_of(const Lanes& lanes, const LaneBlock& block) {
  double sum = 0;
  for (int i = 0; i < block.size; ++i) sum += lanes[i];
  return sum;
}

}  // namespace

MeasuredSurface::MeasuredSurface(const TriangleMesh& mesh, int threads)
    : n_threads_(threads > 0 ? threads : omp_get_max_threads()),
      triangles_(checked(mesh, threads).triangles),
      edges_(triangles_),
      corners_of_node_(triangles_, mesh.points.cols()),
      unit_normal_(3, triangles_.cols()),
      block_area_(n_lane_blocks(n_triangles())),
      block_volume_(n_lane_blocks(n_triangles())),
      length_angle_(edges_.size()),
      angle_by_length_(edges_.size()) {
  measures_.triangle_area.resize(n_triangles());
  measures_.node_area.resize(mesh.points.cols());
  measures_.node_curvature.resize(mesh.points.cols());
  measure(mesh.points, true);
}

int MeasuredSurface::n_triangle_blocks() const {
  return n_lane_blocks(n_triangles());
}
int MeasuredSurface::n_edge_blocks() const {
  return n_lane_blocks(n_edges());
}

void MeasuredSurface::require_column_per_node(const std::string& what, Eigen::Index n_columns) const {
  if (n_columns != n_nodes()) {
    throw std::invalid_argument("energy terms: " + what + " has " + std::to_string(n_columns) +
                                " columns, must have one for each of the " + std::to_string(n_nodes()) +
                                " nodes");
  }
}

/// Areas, normals and tetrahedra of a block of triangles. The volume is that of the tetrahedra from one node
/// of the surface, which keeps digits when it is far from the origin.
void MeasuredSurface::measure_triangles(const Eigen::Matrix3Xd& points, int number) {
  const double* positions = points.data();
  const LaneBlock block(number, n_triangles());
  VectorLanes corner[3], normal;
  Lanes area, six_volumes;
  load_corners(positions, triangles_.data(), block, corner);
  const double apex_x = positions[0], apex_y = positions[1], apex_z = positions[2];
  for (int i = 0; i < n_lanes; ++i) {
    const double x0 = corner[0].x[i], y0 = corner[0].y[i], z0 = corner[0].z[i];
    const double x1 = corner[1].x[i] - x0, y1 = corner[1].y[i] - y0, z1 = corner[1].z[i] - z0;
    const double x2 = corner[2].x[i] - x0, y2 = corner[2].y[i] - y0, z2 = corner[2].z[i] - z0;
    const double x = y1 * z2 - z1 * y2, y = z1 * x2 - x1 * z2, z = x1 * y2 - y1 * x2;
    const double twice_area = std::sqrt(x * x + y * y + z * z), scale = 1.0 / twice_area;
    area[i] = 0.5 * twice_area;
    six_volumes[i] = ((x0 - apex_x) * x + (y0 - apex_y) * y + (z0 - apex_z) * z);
    normal.x[i] = scale * x;
    normal.y[i] = scale * y;
    normal.z[i] = scale * z;
  }
  double* normals = unit_normal_.data() + 3 * block.begin;
  for (int i = 0; i < block.size; ++i) {
    normals[3 * i] = normal.x[i];
    normals[3 * i + 1] = normal.y[i];
    normals[3 * i + 2] = normal.z[i];
    measures_.triangle_area[block.begin + i] = area[i];
  }
  block_area_[number] = sum_of(area, block);
  block_volume_[number] = sum_of(six_volumes, block) / 6.0;
}

/// Angles of a block of edges: of the unit normals n (left) and m (right) and the unit vector e along the
/// edge, sin = (n x m).e and cos = n.m.
void MeasuredSurface::measure_edges(const Eigen::Matrix3Xd& points, int number) {
  const double* positions = points.data();
  const LaneBlock block(number, n_edges());
  VectorLanes from, to, left, right;
  Lanes length_angle, angle_by_length;
  for (int i = 0; i < n_lanes; ++i) {
    const int edge = block.thing(i);
    from.set(i, positions + 3 * edges_.from[edge]);
    to.set(i, positions + 3 * edges_.to[edge]);
    left.set(i, unit_normal_.data() + 3 * edges_.left[edge]);
    right.set(i, unit_normal_.data() + 3 * edges_.right[edge]);
  }
  for (int i = 0; i < n_lanes; ++i) {
    const double x = to.x[i] - from.x[i], y = to.y[i] - from.y[i], z = to.z[i] - from.z[i];
    const double length = std::sqrt(x * x + y * y + z * z), scale = 1.0 / length;
    const double product = x * (left.y[i] * right.z[i] - left.z[i] * right.y[i]) +
                           y * (left.z[i] * right.x[i] - left.x[i] * right.z[i]) +
                           z * (left.x[i] * right.y[i] - left.y[i] * right.x[i]);
    const double cosine = left.x[i] * right.x[i] + left.y[i] * right.y[i] + left.z[i] * right.z[i];
    const double angle = dihedral_angle(scale * product, cosine);
    length_angle[i] = length * angle;
    angle_by_length[i] = scale * angle;
  }
  std::copy_n(length_angle.begin(), block.size, length_angle_.data() + block.begin);
  std::copy_n(angle_by_length.begin(), block.size, angle_by_length_.data() + block.begin);
}

/// Each edge of a node is the side from it of just one of its triangles.
void MeasuredSurface::measure_node(int node) {
  double area = 0, length_angle = 0;
  for (const auto corner : corners_of_node_.of(node)) {
    area += measures_.triangle_area[corner / 3];
    length_angle += length_angle_[edges_.of_side[corner]];
  }
  measures_.node_area[node] = area / 3.0;
  measures_.node_curvature[node] = length_angle / 4.0;
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
      for (int block = 0; block < n_edge_blocks(); ++block) measure_edges(positions, block);
#pragma omp for schedule(static)
      for (int node = 0; node < n_nodes(); ++node) measure_node(node);
    }
  }
  return add_up(with_curvature);
}

void MeasuredSurface::add_corner_forces(const Eigen::Matrix3Xd& positions,
                                        const MeasureDerivatives& derivatives, int number,
                                        Eigen::Matrix3Xd& corner_force) const {
  const LaneBlock block(number, n_triangles());
  VectorLanes corner[3], force[3];
  TriangleLanes triangles;
  CurvatureLanes curvature;
  Lanes tension;
  load_corners(positions.data(), triangles_.data(), block, corner);
  for (int k = 0; k < 3; ++k) subtract(corner[(k + 2) % 3], corner[(k + 1) % 3], triangles.edge[k]);
  for (int i = 0; i < n_lanes; ++i) {
    const int t = block.thing(i);
    triangles.normal.set(i, unit_normal_.data() + 3 * t);
    triangles.area[i] = measures_.triangle_area[t];
    tension[i] = derivatives.area + derivatives.triangle_area[t];
  }
  if (with_curvature_) {
    constexpr double third = 1.0 / 3.0;
    for (int i = 0; i < n_lanes; ++i) {
      const int t = block.thing(i);
      double by_area = 0;
      for (int k = 0; k < 3; ++k) {
        const int node = triangles_(k, t);
        by_area += derivatives.node_area[node];
        curvature.by_node[k][i] = derivatives.node_curvature[node];
        curvature.angle_by_length[k][i] = angle_by_length_[edges_.of_side[3 * t + (k + 1) % 3]];
      }
      tension[i] += third * by_area;
    }
  }
  set_area_forces(triangles, tension, derivatives.volume, force);
  if (with_curvature_) add_curvature_forces(triangles, curvature, force);
  double* forces = corner_force.data() + 9 * block.begin;
  for (int i = 0; i < block.size; ++i) {
    for (int k = 0; k < 3; ++k) {
      forces[9 * i + 3 * k] += force[k].x[i];
      forces[9 * i + 3 * k + 1] += force[k].y[i];
      forces[9 * i + 3 * k + 2] += force[k].z[i];
    }
  }
}

void MeasuredSurface::add_forces(const Eigen::Matrix3Xd& positions, const MeasureDerivatives& derivatives,
                                 Eigen::Ref<Eigen::Matrix3Xd> force) {
  require_column_per_node("the position array", positions.cols());
  require_column_per_node("the force array", force.cols());
  corner_force_.setZero(3, triangles_.size());
#pragma omp parallel num_threads(n_threads_)
  {
#pragma omp for schedule(static)
    for (int block = 0; block < n_triangle_blocks(); ++block)
      add_corner_forces(positions, derivatives, block, corner_force_);
#pragma omp for schedule(static)
    for (int node = 0; node < n_nodes(); ++node) force.col(node) += corners_of_node_.sum(corner_force_, node);
  }
}

}  // namespace tanktread::membrane
