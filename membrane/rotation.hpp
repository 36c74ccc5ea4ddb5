// How a shape is turned: rotation matrices.
#pragma once

#include <Eigen/Core>
#include <array>

namespace tanktread::membrane {

/// The shortest turn that takes the z axis to a direction; where that is -z, half a turn about x. Exactly the
/// unit matrix for +z.
/// @param direction of any length but 0
/// @throws std::invalid_argument if it is 0 or not finite
Eigen::Matrix3d rotation_of_z_to(const Eigen::Vector3d& direction);

/// Euler angles z-x-z: turned about z by the first angle, then about the new x by the second, then about the
/// new z by the third; R = R_z(a0) R_x(a1) R_z(a2), which takes z to (sin a0 sin a1, -cos a0 sin a1, cos a1).
/// Exact for multiples of 90 degrees.
/// @param degrees any finite angles @throws std::invalid_argument if one is not finite
Eigen::Matrix3d rotation_by_euler_angles(const std::array<double, 3>& degrees);

}  // namespace tanktread::membrane
