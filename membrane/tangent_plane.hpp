// The tangent plane of a surface of triangles at a node, and the strain rates of a triangle seen in it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "membrane/element.hpp"

namespace tanktread::membrane {

struct TangentPlane {
  SurfaceGradient axes;  ///< Q, orthonormal columns in space
  double root_area;      ///< the root of the area of the node, a third of its triangles

  bool exists() const { return root_area > 0; }
};

/// @param area_normal sum of the normals of the triangles of the node, of the length of their areas
/// @param area the sum of their areas
/// @param edge axis 1 is along its projection on the plane
/// @return a plane that does not exist if the normals cancel to 10^-6 of the area or less, or the edge stands
/// on the plane to 10^-6: its axes would be rounding, or nearly so
inline TangentPlane tangent_plane(const Eigen::Vector3d& area_normal, double area,
                                  const Eigen::Vector3d& edge) {
  const Eigen::Vector3d normal = area_normal.normalized();
  const Eigen::Vector3d projected = edge - normal.dot(edge) * normal;
  const bool exists = area_normal.norm() > 1e-6 * area && projected.norm() > 1e-6 * edge.norm();
  TangentPlane plane;
  plane.axes.col(0) = projected.normalized();
  plane.axes.col(1) = normal.cross(plane.axes.col(0));
  plane.root_area = exists ? std::sqrt(area / 3) : 0;
  return plane;
}

/// The matrix that takes [D11 - D22, 2 D12, D11 + D22] of a tensor D in the plane of `from` to those of its
/// projection Q^T D Q on the plane of `to`.
inline Eigen::Matrix3d rates_projected(const SurfaceGradient& from, const SurfaceGradient& to) {
  const Eigen::Matrix2d q = to.transpose() * from;  // the projection is q D q^T
  const double a = q(0, 0), b = q(0, 1), c = q(1, 0), d = q(1, 1);
  Eigen::Matrix3d result;
  result << (a * a - b * b - c * c + d * d) / 2, a * b - c * d, (a * a + b * b - c * c - d * d) / 2,  //
      a * c - b * d, a * d + b * c, a * c + b * d,                                                    //
      (a * a - b * b + c * c - d * d) / 2, a * b + c * d, (a * a + b * b + c * c + d * d) / 2;
  return result;
}

}  // namespace tanktread::membrane
