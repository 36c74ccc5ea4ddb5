// The exact motion of a sphere that is twisted about its z axis, to and fro.
#pragma once

#include <Eigen/Core>

namespace tanktread::driver {

/// Spherical unit vectors at a point, and its polar angle from the z axis. On the axis itself e_theta is
/// taken along x.
struct SphericalFrame {
  double polar_angle;  ///< theta
  Eigen::Vector3d e_theta, e_phi;
};

/// Points of a sphere whose azimuth is phi0 + A0 sin(theta) (1 - cos(omega t)) (Eq. 3.35). Lengths in grid
/// steps, times in time steps.
struct TwistingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 20;    ///< R
  double amplitude = 0;  ///< A0, radians
  double period = 1e4;   ///< T0

  double frequency() const;            ///< omega = 2 pi/T0
  double nominal_strain_rate() const;  ///< A0 omega/4 (Eq. 3.40)

  /// Positions at a time of points that are at `start` at t = 0, 3 x n.
  Eigen::Matrix3Xd twisted(const Eigen::Matrix3Xd& start, double time) const;

  /// The velocity of the surface, extended into space: A0 omega r sin^2(theta) sin(omega t) along e_phi
  /// (Eq. 3.39). Zero at the centre.
  Eigen::Vector3d velocity(const Eigen::Vector3d& position, double time) const;

  SphericalFrame frame(const Eigen::Vector3d& position) const;

  /// theta-phi component of the rate of deformation, the only one that is not zero (Eq. 3.37).
  double shear_rate(double polar_angle, double time) const;

  /// theta-phi component of the stress of a Maxwell element of viscosity mu_s and relaxation time tau_s that
  /// sees this rate and is free of stress at t = 0 (Eq. 3.38; force per length if mu_s is force times steps
  /// per length).
  double shear_stress(double polar_angle, double time, double viscosity, double relaxation_time) const;
};

}  // namespace tanktread::driver
