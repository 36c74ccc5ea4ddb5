// What the tests of the strain-rate operator share: short ways to call it, a shape, a velocity, and rounding.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "membrane/element.hpp"
#include "membrane/strain_rates.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {

inline constexpr double mu_s = 2, mu_d = 3;

inline StrainRates at(const TriangleMesh& mesh, RatesAt where, double shear_viscosity = mu_s,
                      double dilatational_viscosity = mu_d, int threads = 1) {
  StrainRates rates(mesh.triangles, mesh.points.cols(), shear_viscosity, dilatational_viscosity, where,
                    threads);
  rates.set_positions(mesh.points);
  return rates;
}

inline Eigen::Matrix3Xd product(const StrainRates& rates, const Eigen::Matrix3Xd& velocity) {
  Eigen::Matrix3Xd result(3, rates.n_rates());
  rates.multiply(velocity, result);
  return result;
}

inline Eigen::Matrix3Xd transposed_product(const StrainRates& rates, const Eigen::Matrix3Xd& of_rates) {
  Eigen::Matrix3Xd result(3, rates.n_nodes());
  rates.multiply_transposed(of_rates, result);
  return result;
}

/// Tests of both forms.
class StrainRatesAt : public testing::TestWithParam<RatesAt> {};

inline std::string name_of(const testing::TestParamInfo<RatesAt>& tested) {
  return tested.param == RatesAt::nodes ? "nodes" : "elements";
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
///
/// At nodes: the axes of the node add r again, 4.2 r; numbers of a tensor that is off by so much in each
/// entry are off by sqrt(2) times as much in other axes; and the area of a node, a third of six triangles, is
/// below twice that of the largest. Together 2.7 times as much; 3 with the rounding of the sum.
inline double rate_rounding(const TriangleMesh& present, double size, RatesAt where) {
  return (where == RatesAt::nodes ? 3 : 1) * 2 * 3.2 * size * gradient_rounding(present, present.points) *
         std::sqrt(areas(present).maxCoeff() * std::max(mu_s, mu_d));
}

/// Of an element, in space: the symmetric part of the velocity gradient between projections on its plane.
inline Eigen::Matrix3d rate_of_deformation(const TriangleMesh& present, const Eigen::Matrix3Xd& velocity,
                                           Eigen::Index t) {
  const Eigen::Vector3i nodes = present.triangles.col(t);
  const auto element = reference_element(corners_of(present.points, nodes));
  const SurfaceGradient axes = deformation_gradient(corners_of(present.points, nodes), element);
  const Eigen::Matrix3d gradient =
      axes * axes.transpose() * deformation_gradient(corners_of(velocity, nodes), element) * axes.transpose();
  return 0.5 * (gradient + gradient.transpose());
}

/// Eq. 2.9 in space. @param plane the projection on the plane of D
inline Eigen::Matrix3d viscous_tension(const Eigen::Matrix3d& d, const Eigen::Matrix3d& plane,
                                       double shear_viscosity = mu_s, double dilatational_viscosity = mu_d) {
  return shear_viscosity * (2 * d - d.trace() * plane) + dilatational_viscosity * d.trace() * plane;
}

inline Eigen::Matrix3d tensor(const Eigen::Matrix<double, 9, Eigen::Dynamic>& row_by_row, Eigen::Index t) {
  return row_by_row.col(t).reshaped<Eigen::RowMajor>(3, 3);
}

}  // namespace tanktread::membrane::test
