// What the tests of the strain-rate operator share: short ways to call it, a shape, a velocity, and rounding.
#pragma once

#include <algorithm>
#include <cmath>

#include "membrane/element.hpp"
#include "membrane/strain_rates.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {

inline constexpr double mu_s = 2, mu_d = 3;

inline StrainRates at(const TriangleMesh& mesh, double shear_viscosity = mu_s,
                      double dilatational_viscosity = mu_d, int threads = 1) {
  StrainRates rates(mesh.triangles, mesh.points.cols(), shear_viscosity, dilatational_viscosity, threads);
  rates.set_positions(mesh.points);
  return rates;
}

inline Eigen::Matrix3Xd product(const StrainRates& rates, const Eigen::Matrix3Xd& velocity) {
  Eigen::Matrix3Xd result(3, rates.n_elements());
  rates.multiply(velocity, result);
  return result;
}

inline Eigen::Matrix3Xd transposed_product(const StrainRates& rates, const Eigen::Matrix3Xd& of_elements) {
  Eigen::Matrix3Xd result(3, rates.n_nodes());
  rates.multiply_transposed(of_elements, result);
  return result;
}

/// A sphere deformed without any symmetry.
inline TriangleMesh deformed_sphere(int level) {
  auto mesh = icosphere(level, 1);
  mesh.points = smoothly_deformed(mesh.points);
  return mesh;
}

/// A smooth velocity field that stretches, shears and bends.
inline Eigen::Matrix3Xd smooth_velocity(const Eigen::Matrix3Xd& points) {
  Eigen::Matrix3Xd velocity = points;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const double x = points(0, k), y = points(1, k), z = points(2, k);
    velocity.col(k) << std::sin(x + 0.4) * y, std::cos(y - z) + x * z, z * z + std::sin(x);
  }
  return velocity;
}

inline Eigen::VectorXd areas(const TriangleMesh& mesh) {
  Eigen::VectorXd result(mesh.triangles.cols());
  for (Eigen::Index t = 0; t < result.size(); ++t)
    result[t] = reference_element(corners_of(mesh.points, mesh.triangles.col(t))).area;
  return result;
}

/// Rounding of B u where the velocity is that of a linear flow of gradient `size` at most. An entry of the
/// velocity gradient in space is off by r = gradient_rounding() as one of F is, with 10 roundings of the size
/// of the velocity in place of 8, for the velocity itself has three: 1.25 r. On an axis in the plane
/// sqrt(3) as much, and the axis, rounded like an entry of F, adds r at most: below 3.2 r. Each number has
/// two such entries, times the root of area and viscosity.
inline double rate_rounding(const TriangleMesh& present, double size) {
  return 2 * 3.2 * size * gradient_rounding(present, present.points) *
         std::sqrt(areas(present).maxCoeff() * std::max(mu_s, mu_d));
}

}  // namespace tanktread::membrane::test
