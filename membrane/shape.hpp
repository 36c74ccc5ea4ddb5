// Measures of a closed surface: volume, area, the equivalent ellipsoid, and the capsule's D and inclination.
#pragma once

#include <Eigen/Core>

#include "membrane/mesh.hpp"

namespace tanktread::membrane {

/// Moments of the enclosed volume by surface integrals (divergence theorem; exact for flat triangles).
struct VolumeMoments {
  double volume = 0;
  Eigen::Vector3d centroid;
  Eigen::Matrix3d second_moment;  ///< integral of (x - centroid)(x - centroid)^T over the volume
};
VolumeMoments volume_moments(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Eigen::Ref<const Eigen::Matrix3Xi>& triangles);

double surface_area(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    const Eigen::Ref<const Eigen::Matrix3Xi>& triangles);

/// The ellipsoid of the same volume moments, seen in the shear plane (flow axis, gradient axis).
/// For a solid ellipsoid the second moment along a semi-axis a is V a^2 / 5.
struct Deformation {
  double deformation = 0;      ///< D = (length - width)/(length + width)
  double inclination_deg = 0;  ///< of the long axis to the flow axis, in (-90, 90]; 0 for a circle
  double length = 0;   ///< long semi-axis in the shear plane (twice the in-plane eigenvalue 5 m / V, rooted)
  double width = 0;    ///< short semi-axis in the shear plane
  double breadth = 0;  ///< semi-axis along the vorticity axis
};
/// @param flow_axis, gradient_axis 0, 1, 2 and different; the vorticity axis is the third
Deformation deformation(const VolumeMoments& moments, int flow_axis, int gradient_axis);

}  // namespace tanktread::membrane
