// Measures of a closed surface: volume, area, the equivalent ellipsoid, and the capsule's D and inclination.
#pragma once

#include <Eigen/Core>

#include "membrane/mesh.hpp"

namespace tanktread::membrane {

/// Moments of the enclosed volume by surface integrals (divergence theorem; exact for flat triangles).
struct VolumeMoments {
  double volume = 0;              ///< negative if the triangles are wound inside out
  Eigen::Vector3d centroid;       ///< not finite if the volume is zero
  Eigen::Matrix3d second_moment;  ///< integral of (x - centroid)(x - centroid)^T over the volume
};
/// @param points 3 x n_nodes
/// @param triangles 3 x n_triangles, at least one; a closed surface, counter-clockwise seen from outside
VolumeMoments volume_moments(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Eigen::Ref<const Eigen::Matrix3Xi>& triangles);

/// Velocity of the centroid of the enclosed volume while the nodes move: the integral of (x - centroid)(v .
/// n) over the surface, by the volume; exact for flat triangles and velocities that are linear in them. Of a
/// rigid motion it is that of the point of the body.
/// @param moments of these points and triangles
/// @param velocity v of the nodes, 3 x n_nodes
Eigen::Vector3d centroid_velocity(const VolumeMoments& moments,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                  const Eigen::Ref<const Eigen::Matrix3Xi>& triangles,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& velocity);

/// The node nearest to a place; of several the one of the lowest number. @param points at least one
Eigen::Index nearest_node(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const Eigen::Vector3d& place);

/// Sum of the areas of the triangles, in the square of the points' unit.
/// @param points 3 x n_nodes
/// @param triangles 3 x n_triangles; open or closed, wound either way
double surface_area(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    const Eigen::Ref<const Eigen::Matrix3Xi>& triangles);

/// The ellipsoid of the same volume moments, seen in the shear plane (flow axis, gradient axis). A solid
/// ellipsoid of semi-axis a has the second moment V a^2/5 along it, so a semi-axis is sqrt(5 m/V) of a
/// principal second moment m.
struct Deformation {
  double deformation = 0;      ///< D = (length - width)/(length + width) (Taylor)
  double inclination_deg = 0;  ///< of the long axis to the flow axis, in (-90, 90]; 0 for a circle
  double length = 0;           ///< long semi-axis in the shear plane
  double width = 0;            ///< short semi-axis in the shear plane
  double breadth = 0;          ///< semi-axis along the vorticity axis
};
/// A section rounder than D = 1e-12 counts as a circle: its long axis would be one of rounding.
/// @param flow_axis, gradient_axis 0, 1, 2 and different; the vorticity axis is the third
/// @throws std::invalid_argument for other axes
Deformation deformation(const VolumeMoments& moments, int flow_axis, int gradient_axis);

}  // namespace tanktread::membrane
