// From the derivatives of an energy by the measures of a surface to the forces on the corners of its
// triangles.
#include "membrane/measured_surface.hpp"

namespace tanktread::membrane {
namespace {

/// A triangle. Edge k is opposite to its corner k, from corner k + 1 to corner k + 2.
struct Triangle {
  LaneVector edge0, edge1, edge2;
  LaneVector normal;  ///< unit
  double area;
};

/// Forces on the corners of a triangle.
struct CornerForces {
  LaneVector force0, force1, force2;
};

/// Of a tension and of a pressure inwards: the gradient of the area by corner k is (n x edge k)/2, that of
/// the volume by a node the sum of A n/3 over its triangles.
__attribute__((always_inline)) inline CornerForces area_forces(const Triangle& t, double tension,
                                                               double pressure) {
  const double half = -0.5 * tension;
  const LaneVector push = pressure / 3.0 * t.area * t.normal;
  return {half * t.normal.cross(t.edge0) - push, half * t.normal.cross(t.edge1) - push,
          half * t.normal.cross(t.edge2) - push};
}

/// Subtracts what the curvature adds to the gradients. The derivative w by length times angle of an edge is a
/// fourth of the sum of m = dE/dM_i over its two nodes. The two parts of its gradient:
/// - w length d(angle) is along the normals. In a triangle those of the three edges add up to n times
///   [(m_k - m_k+1) cot k+2 + (m_k - m_k+2) cot k+1]/4 at corner k.
/// - w angle d(length) is w angle/length times the edge, half of it by either of the two triangles.
/// @param m0, m1, m2 of the corners @param ratio0, ratio1, ratio2 angle over length of the edges
__attribute__((always_inline)) inline void add_curvature_forces(const Triangle& t, double m0, double m1,
                                                                double m2, double ratio0, double ratio1,
                                                                double ratio2, CornerForces& forces) {
  const double by_area = -0.125 / t.area;  // a fourth of that of the cotangents
  const double push0 = (m1 - m2) * by_area * t.edge1.dot(t.edge2);
  const double push1 = (m2 - m0) * by_area * t.edge2.dot(t.edge0);
  const double push2 = (m0 - m1) * by_area * t.edge0.dot(t.edge1);
  const LaneVector pull0 = 0.125 * (m1 + m2) * ratio0 * t.edge0;
  const LaneVector pull1 = 0.125 * (m2 + m0) * ratio1 * t.edge1;
  const LaneVector pull2 = 0.125 * (m0 + m1) * ratio2 * t.edge2;
  forces.force0 = forces.force0 - (push2 - push1) * t.normal - pull1 + pull2;
  forces.force1 = forces.force1 - (push0 - push2) * t.normal - pull2 + pull0;
  forces.force2 = forces.force2 - (push1 - push0) * t.normal - pull0 + pull1;
}

}  // namespace

void MeasuredSurface::find_corner_forces(const MeasureDerivatives& derivatives, int number) {
  const double* edge0 = shapes_.row(number, edge_row);
  const double* edge1 = shapes_.row(number, edge_row + 3);
  const double* edge2 = shapes_.row(number, edge_row + 6);
  const double* normal = shapes_.row(number, normal_row);
  const double* area = shapes_.row(number, area_row);
  double* force0 = corner_forces_.row(number, 0);
  double* force1 = corner_forces_.row(number, 3);
  double* force2 = corner_forces_.row(number, 6);
  Lanes tension = lanes_of(derivatives.triangle_area.data(), LaneBlock(number, n_triangles()));
  Lanes m0{}, m1{}, m2{}, ratio0{}, ratio1{}, ratio2{};
  for (int i = 0; i < n_lanes; ++i) tension[i] += derivatives.area;
  if (with_curvature_) {
    const auto& [node, position, edge] = triangle_indices_[number];
    const double* by_area = derivatives.node_area.data();
    const double* by_curvature = derivatives.node_curvature.data();
    const double* ratio = angle_by_length_.data();
    for (int i = 0; i < n_lanes; ++i)
      tension[i] += (by_area[node[0][i]] + by_area[node[1][i]] + by_area[node[2][i]]) / 3.0;
    for (int i = 0; i < n_lanes; ++i) {
      m0[i] = by_curvature[node[0][i]];
      m1[i] = by_curvature[node[1][i]];
      m2[i] = by_curvature[node[2][i]];
      ratio0[i] = ratio[edge[0][i]];
      ratio1[i] = ratio[edge[1][i]];
      ratio2[i] = ratio[edge[2][i]];
    }
  }
  // Without curvature all of it is zero; a loop of its own would save little. What the loop calls is inlined
  // always, without which it is no loop of vectors.
  const double pressure = derivatives.volume;
#pragma omp simd
  for (int i = 0; i < n_lanes; ++i) {
    const Triangle t{LaneVector::of_rows(edge0, i), LaneVector::of_rows(edge1, i),
                     LaneVector::of_rows(edge2, i), LaneVector::of_rows(normal, i), area[i]};
    CornerForces forces = area_forces(t, tension[i], pressure);
    add_curvature_forces(t, m0[i], m1[i], m2[i], ratio0[i], ratio1[i], ratio2[i], forces);
    forces.force0.put(force0, i);
    forces.force1.put(force1, i);
    forces.force2.put(force2, i);
  }
}

}  // namespace tanktread::membrane
