// Strain rates in the plane of one linear triangle, and the nodal forces that go with them. Header only:
// inlined into the loops over elements.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "membrane/element.hpp"

namespace tanktread::membrane {

/// What of an element at its present shape, of area A, enters its strain rates. Axis 1 is along the edge from
/// corner 0 to corner 1, axis 2 in the plane of the element towards corner 2.
struct ElementRates {
  SurfaceGradient axes;               ///< the axes in space, columns
  SurfaceGradient weighted_gradient;  ///< sqrt(A) grad N_a in those axes, a row a corner
  double root_area;                   ///< sqrt(A)

  /// A sum |grad N_a|^2 = (sum of the squared edges)/(4 A); it is not a number where a position is none.
  bool has_area() const { return weighted_gradient.squaredNorm() < 1e12; }

  double area() const { return root_area * root_area; }
  Eigen::Vector3d normal() const { return axes.col(0).cross(axes.col(1)); }  ///< of length 1
};

/// Edges from corner 0 to corners 1 and 2, as columns: of nodal velocities, they are exactly zero in a
/// translation.
template <class Points>
SurfaceGradient edges_of(const Points& points, const Eigen::Vector3i& nodes) {
  SurfaceGradient edges;
  edges.col(0) = points.col(nodes[1]) - points.col(nodes[0]);
  edges.col(1) = points.col(nodes[2]) - points.col(nodes[0]);
  return edges;
}

/// @param edges of the positions. Not numbers come out if there is no area: ask has_area()
inline ElementRates element_rates(const SurfaceGradient& edges) {
  Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();  // seen from corner 0
  corners.rightCols<2>() = edges;
  // Its own reference: the deformation gradient is then the axes themselves.
  const ReferenceElement present = reference_element(corners);
  const double root_area = std::sqrt(present.area);
  return {deformation_gradient(corners, present), root_area * present.shape_gradient, root_area};
}

/// sqrt(A) [D11 - D22, 2 D12, D11 + D22] in the axes of the element. @param edges of the velocities
inline Eigen::Vector3d weighted_rates(const ElementRates& element, const SurfaceGradient& edges) {
  const SurfaceGradient in_space = edges * element.weighted_gradient.bottomRows<2>();
  const Eigen::Matrix2d gradient = element.axes.transpose() * in_space;
  return {gradient(0, 0) - gradient(1, 1), gradient(0, 1) + gradient(1, 0), gradient(0, 0) + gradient(1, 1)};
}

/// The deformation gradient from one shape of an element to another, each in its own axes.
inline Eigen::Matrix2d motion_between(const ElementRates& from, const ElementRates& to) {
  // The gradients of the shape functions of corners 1 and 2 are the inverse of the edges from corner 0.
  return to.root_area / from.root_area * to.weighted_gradient.bottomRows<2>().inverse() *
         from.weighted_gradient.bottomRows<2>();
}

/// A tensor in a plane as [(t11 - t22)/2, t12, (t11 + t22)/2] times any number, turned by the polar rotation
/// of a deformation gradient (or of any positive multiple of it).
inline Eigen::Vector3d turned(const Eigen::Vector3d& t, const Eigen::Matrix2d& gradient) {
  const double c = gradient(0, 0) + gradient(1, 1), s = gradient(1, 0) - gradient(0, 1);
  const double size = c * c + s * s;  // of the cosine and the sine, squared
  const double cos_twice = (c * c - s * s) / size, sin_twice = 2 * c * s / size;
  return {cos_twice * t[0] - sin_twice * t[1], sin_twice * t[0] + cos_twice * t[1], t[2]};
}

/// A tensor in a plane from t = [(t11 - t22)/2, t12, (t11 + t22)/2], in space.
inline Eigen::Matrix3d tensor_in_space(const SurfaceGradient& axes, const Eigen::Vector3d& t) {
  return axes * SymmetricTensor{t[2] + t[0], t[1], t[2] - t[0]}.matrix() * axes.transpose();
}

/// The transpose of weighted_rates(): A tau grad N_a of the three corners, as columns, where
/// sqrt(A) tau is the tensor of `stress` as in tensor_in_space().
inline Eigen::Matrix3d transposed_rates(const ElementRates& element, const Eigen::Vector3d& stress) {
  const SurfaceGradient in_space =
      element.axes * SymmetricTensor{stress[2] + stress[0], stress[1], stress[2] - stress[0]}.matrix();
  return in_space * element.weighted_gradient.transpose();
}

}  // namespace tanktread::membrane
