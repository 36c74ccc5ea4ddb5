#include "driver/study/twisting_sphere.hpp"

#include <cmath>
#include <numbers>

#include "driver/study/study_maxwell.hpp"

namespace tanktread::driver {

double TwistingSphere::frequency() const {
  return 2.0 * std::numbers::pi / period;
}

double TwistingSphere::nominal_strain_rate() const {
  return 0.25 * amplitude * frequency();
}

Eigen::Matrix3Xd TwistingSphere::twisted(const Eigen::Matrix3Xd& start, double time) const {
  const double phase = 1.0 - std::cos(frequency() * time);
  Eigen::Matrix3Xd positions = start;
  for (Eigen::Index k = 0; k < start.cols(); ++k) {
    const Eigen::Vector3d from_centre = start.col(k) - centre;
    const double angle = amplitude * from_centre.head<2>().norm() / from_centre.norm() * phase;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    positions(0, k) = centre.x() + cosine * from_centre.x() - sine * from_centre.y();
    positions(1, k) = centre.y() + sine * from_centre.x() + cosine * from_centre.y();
  }
  return positions;
}

Eigen::Vector3d TwistingSphere::velocity(const Eigen::Vector3d& position, double time) const {
  const Eigen::Vector3d from_centre = position - centre;
  const double distance = from_centre.norm();
  if (distance == 0) return Eigen::Vector3d::Zero();
  // r sin^2(theta) e_phi is the distance from the axis over that from the centre, times (-y, x, 0).
  const double sine = from_centre.head<2>().norm() / distance;
  return amplitude * frequency() * std::sin(frequency() * time) * sine *
         Eigen::Vector3d(-from_centre.y(), from_centre.x(), 0.0);
}

SphericalFrame TwistingSphere::frame(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d from_centre = position - centre;
  const double from_axis = from_centre.head<2>().norm(), distance = from_centre.norm();
  Eigen::Vector2d outward(1.0, 0.0);  // from the axis
  if (from_axis > 0) outward = from_centre.head<2>() / from_axis;
  const double cosine = from_centre.z() / distance, sine = from_axis / distance;
  return {std::atan2(from_axis, from_centre.z()),
          {cosine * outward.x(), cosine * outward.y(), -sine},
          {-outward.y(), outward.x(), 0.0}};
}

double TwistingSphere::shear_rate(double polar_angle, double time) const {
  return nominal_strain_rate() * std::sin(2.0 * polar_angle) * std::sin(frequency() * time);
}

double TwistingSphere::shear_stress(double polar_angle, double time, double viscosity,
                                    double relaxation_time) const {
  // Eq. 3.38 is the Maxwell element of Eq. 3.32 under the strain whose rate is shear_rate().
  const MaxwellStudy element{
      .viscosity = viscosity,
      .stiffness = viscosity / relaxation_time,
      .strain_amplitude = nominal_strain_rate() * std::sin(2.0 * polar_angle) / frequency(),
      .period = period};
  return exact_stress(element, time);
}

}  // namespace tanktread::driver
