#include "membrane/rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace tanktread::membrane {
namespace {

/// v x, as a matrix.
Eigen::Matrix3d cross_with(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

struct Turn {
  double cosine, sine;
};

/// From an angle within 45 degrees of a quarter turn, so that whole quarters are exact.
Turn turn_by(double degrees) {
  if (!std::isfinite(degrees)) {
    throw std::invalid_argument("rotation: an angle is " + std::to_string(degrees) + ", must be finite");
  }
  int n_quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &n_quarters) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (n_quarters & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

Eigen::Matrix3d about_z(double degrees) {
  const auto [c, s] = turn_by(degrees);
  Eigen::Matrix3d matrix;
  matrix << c, -s, 0, s, c, 0, 0, 0, 1;
  return matrix;
}

Eigen::Matrix3d about_x(double degrees) {
  const auto [c, s] = turn_by(degrees);
  Eigen::Matrix3d matrix;
  matrix << 1, 0, 0, 0, c, -s, 0, s, c;
  return matrix;
}

}  // namespace

Eigen::Matrix3d rotation_of_z_to(const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) {
    throw std::invalid_argument("rotation: a direction of length " + std::to_string(length) +
                                ", must be positive and finite");
  }
  const Eigen::Vector3d to = direction / length;
  // Rodrigues's formula for the axis v = z x to, |v| = sine: R = I + [v] + (1 - cosine) [v/|v|]^2, where
  // 1 - cosine = |v|^2/(1 + cosine) loses no digits above the plane z = 0.
  const Eigen::Vector3d v(-to[1], to[0], 0);
  const double cosine = to[2], sine = std::hypot(to[0], to[1]);
  if (cosine >= 0) {
    const Eigen::Matrix3d k = cross_with(v);
    return Eigen::Matrix3d::Identity() + k + k * k / (1 + cosine);
  }
  if (sine == 0) return Eigen::Vector3d(1, -1, -1).asDiagonal();
  const Eigen::Matrix3d k = cross_with(v / sine);
  return Eigen::Matrix3d::Identity() + sine * k + (1 - cosine) * k * k;
}

Eigen::Matrix3d rotation_by_euler_angles(const std::array<double, 3>& degrees) {
  return about_z(degrees[0]) * about_x(degrees[1]) * about_z(degrees[2]);
}

}  // namespace tanktread::membrane
