// Kinematics of a linear triangle in space, and the nodal force of a stress in it. Header only: inlined into
// the loop over elements.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "membrane/elastic_law.hpp"
#include "membrane/symmetric_tensor.hpp"

namespace tanktread::membrane {

/// 3 x 2: from the plane of the reference triangle into space.
using SurfaceGradient = Eigen::Matrix<double, 3, 2>;

/// What of the reference triangle enters a step. Its plane has the first axis along the edge from corner 0 to
/// corner 1.
struct ReferenceElement {
  Eigen::Matrix<double, 3, 2> shape_gradient;  ///< grad N_a, a row a corner: F = X shape_gradient
  double area;                                 ///< A0
};

/// Corners of a triangle as columns. @param points 3 x n_nodes @param nodes its three node indices
template <class Points>
Eigen::Matrix3d corners_of(const Points& points, const Eigen::Vector3i& nodes) {
  Eigen::Matrix3d corners;
  for (int corner = 0; corner < 3; ++corner) corners.col(corner) = points.col(nodes[corner]);
  return corners;
}

/// Corners as columns. The area must not be zero.
inline ReferenceElement reference_element(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d edge1 = corners.col(1) - corners.col(0), edge2 = corners.col(2) - corners.col(0);
  const double length = edge1.norm();
  const double x = edge2.dot(edge1) / length, y = edge1.cross(edge2).norm() / length;
  ReferenceElement element;
  element.area = 0.5 * length * y;
  // N_1 = (X - x/y Y)/length, N_2 = Y/y, N_0 = 1 - N_1 - N_2.
  element.shape_gradient.row(1) << 1.0 / length, -x / (y * length);
  element.shape_gradient.row(2) << 0.0, 1.0 / y;
  element.shape_gradient.row(0) = -element.shape_gradient.row(1) - element.shape_gradient.row(2);
  return element;
}

/// Deformation gradient F = dx/dX: the columns are the images of the two axes of the reference plane.
inline SurfaceGradient deformation_gradient(const Eigen::Matrix3d& corners, const ReferenceElement& element) {
  return corners * element.shape_gradient;
}

/// Right Cauchy-Green tensor Cg = F^T F, called c below; the Green strain is E = (Cg - I)/2 (Eq. 2.8).
inline SymmetricTensor cauchy_green(const SurfaceGradient& gradient) {
  const auto x = gradient.col(0), y = gradient.col(1);
  return {x.dot(x), x.dot(y), y.dot(y)};
}

/// Principal stretches lambda1 >= lambda2, the square roots of the eigenvalues of Cg.
inline Eigen::Vector2d principal_stretches(const SymmetricTensor& c) {
  const double largest = 0.5 * c.trace() + std::hypot(0.5 * (c.xx - c.yy), c.xy);
  // The smaller square from the product of both, not from a difference that loses digits.
  return {std::sqrt(largest), std::sqrt(c.determinant() / largest)};
}

/// Invariants of the strain (Eq. 2.5).
inline Invariants invariants(const SymmetricTensor& c) {
  return {c.trace() - 2.0, c.determinant() - 1.0};
}

/// Right stretch tensor U of F = R U, U^2 = Cg, by what is needed of it.
struct RightStretch {
  SymmetricTensor inverse;  ///< U^-1
  double area_ratio;        ///< J = det U
};

/// In closed form: by Cayley-Hamilton in two dimensions U = (Cg + J I)/t, t = tr U = sqrt(tr Cg + 2 J) with
/// J = sqrt(det Cg), and so U^-1 = (adj Cg + J I)/(J t).
inline RightStretch right_stretch(const SymmetricTensor& c) {
  const double area_ratio = std::sqrt(c.determinant());
  const double scale = 1.0 / (area_ratio * std::sqrt(c.trace() + 2.0 * area_ratio));
  return {scale * SymmetricTensor{c.yy + area_ratio, -c.xy, c.xx + area_ratio}, area_ratio};
}

/// Polar rotation R = F U^-1: its two orthonormal columns are the axes of the frame that turns with the
/// element, in space.
inline SurfaceGradient polar_rotation(const SurfaceGradient& gradient, const RightStretch& stretch) {
  return gradient * stretch.inverse.matrix();
}

/// Second Piola-Kirchhoff stress of an elastic response, S = 2 (W_1 I + W_2 adj Cg).
inline SymmetricTensor second_piola_kirchhoff(const SymmetricTensor& c, const ElasticResponse& response) {
  return 2.0 * SymmetricTensor{response.w1 + response.w2 * c.yy, -response.w2 * c.xy,
                               response.w1 + response.w2 * c.xx};
}

/// Second Piola-Kirchhoff stress of a Cauchy stress s given in the frame of the polar rotation (sigma =
/// R s R^T in space): S = J F^-1 sigma F^-T = J U^-1 s U^-1.
inline SymmetricTensor pulled_back(const SymmetricTensor& rotated_cauchy_stress,
                                   const RightStretch& stretch) {
  return stretch.area_ratio * on_both_sides(stretch.inverse, rotated_cauchy_stress);
}

/// Cauchy stress in space, F S F^T / J with J = sqrt(det Cg), force per length.
inline Eigen::Matrix3d cauchy_stress(const SurfaceGradient& gradient, const SymmetricTensor& stress) {
  return gradient * stress.matrix() * gradient.transpose() / std::sqrt(cauchy_green(gradient).determinant());
}

/// Forces on the three corners, -A0 P grad N_a with P = F S (first Piola-Kirchhoff stress), as columns. They
/// sum to zero, and so do their moments, for S is symmetric.
inline Eigen::Matrix3d corner_forces(const SurfaceGradient& gradient, const SymmetricTensor& stress,
                                     const ReferenceElement& element) {
  const Eigen::Vector3d x = gradient.col(0), y = gradient.col(1);
  SurfaceGradient force;  // -A0 P
  force.col(0) = -element.area * (stress.xx * x + stress.xy * y);
  force.col(1) = -element.area * (stress.xy * x + stress.yy * y);
  return force * element.shape_gradient.transpose();
}

/// Twice the area times the unit normal, outward for counter-clockwise corners.
inline Eigen::Vector3d area_normal(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d edge1 = corners.col(1) - corners.col(0), edge2 = corners.col(2) - corners.col(0);
  return edge1.cross(edge2);
}

}  // namespace tanktread::membrane
