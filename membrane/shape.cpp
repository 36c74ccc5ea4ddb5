#include "membrane/shape.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "membrane/element.hpp"

namespace tanktread::membrane {
namespace {

/// Below this D a section is a circle. The moments of 20480 triangles carry a rounding of some 1e-14.
constexpr double least_deformation = 1e-12;

}  // namespace

VolumeMoments volume_moments(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Eigen::Ref<const Eigen::Matrix3Xi>& triangles) {
  // Signed tetrahedra from one point near the surface to each triangle; taking a point of the surface instead
  // of the origin keeps digits when the capsule is far from it.
  const Eigen::Vector3d apex = points.col(triangles(0, 0));
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d a = points.col(triangles(0, t)) - apex;
    const Eigen::Vector3d b = points.col(triangles(1, t)) - apex;
    const Eigen::Vector3d c = points.col(triangles(2, t)) - apex;
    const double tetrahedron = a.dot(b.cross(c)) / 6.0;
    const Eigen::Vector3d sum = a + b + c;
    volume += tetrahedron;
    first += tetrahedron / 4.0 * sum;
    // Integral of x x^T over a tetrahedron with one corner at the origin: V/20 (sum of c c^T + sum sum^T).
    second += tetrahedron / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  VolumeMoments moments;
  moments.volume = volume;
  const Eigen::Vector3d centroid = first / volume;
  moments.centroid = apex + centroid;
  moments.second_moment = second - volume * centroid * centroid.transpose();
  return moments;
}

Eigen::Vector3d centroid_velocity(const VolumeMoments& moments,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                  const Eigen::Ref<const Eigen::Matrix3Xi>& triangles,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& velocity) {
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Matrix3d corners = corners_of(points, triangles.col(t)).colwise() - moments.centroid;
    // v . n times the area, at the corners. Two linear functions f and g have the integral
    // A/12 (sum f sum g + sum f g) over a triangle.
    const Eigen::Vector3d flux =
        0.5 * corners_of(velocity, triangles.col(t)).transpose() * area_normal(corners);
    integral += (corners.rowwise().sum() * flux.sum() + corners * flux) / 12;
  }
  return integral / moments.volume;
}

Eigen::Index nearest_node(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const Eigen::Vector3d& place) {
  const auto distance = [&](Eigen::Index node) { return (points.col(node) - place).squaredNorm(); };
  Eigen::Index nearest = 0;
  for (Eigen::Index node = 1; node < points.cols(); ++node)
    if (distance(node) < distance(nearest)) nearest = node;
  return nearest;
}

double surface_area(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    const Eigen::Ref<const Eigen::Matrix3Xi>& triangles) {
  double area = 0;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    area += 0.5 * area_normal(corners_of(points, triangles.col(t))).norm();
  }
  return area;
}

Deformation deformation(const VolumeMoments& moments, int flow_axis, int gradient_axis) {
  if (flow_axis == gradient_axis || flow_axis < 0 || flow_axis > 2 || gradient_axis < 0 ||
      gradient_axis > 2) {
    throw std::invalid_argument("deformation: flow and gradient axis must be two different ones of 0, 1, 2");
  }
  const int vorticity_axis = 3 - flow_axis - gradient_axis;
  const auto& m = moments.second_moment;
  const double flow = m(flow_axis, flow_axis), gradient = m(gradient_axis, gradient_axis);
  const double mixed = m(flow_axis, gradient_axis);
  const double mean = 0.5 * (flow + gradient), half_difference = 0.5 * (flow - gradient);
  // Mohr's circle: the principal moments are mean +- radius, at half the angle of (half_difference, mixed).
  const double radius = std::hypot(half_difference, mixed);
  const auto semi_axis = [&](double moment) { return std::sqrt(5.0 * moment / moments.volume); };
  Deformation result;
  result.length = semi_axis(mean + radius);
  result.width = semi_axis(mean - radius);
  result.breadth = semi_axis(m(vorticity_axis, vorticity_axis));
  result.deformation = (result.length - result.width) / (result.length + result.width);
  if (result.deformation > least_deformation) {
    result.inclination_deg = 0.5 * std::atan2(mixed, half_difference) * 180.0 / std::numbers::pi;
    if (result.inclination_deg <= -90.0) result.inclination_deg += 180.0;
  }
  return result;
}

}  // namespace tanktread::membrane
