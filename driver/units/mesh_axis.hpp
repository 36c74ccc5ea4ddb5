// Where the axis of a mesh points.
#pragma once

#include <Eigen/Core>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// The direction, of length 1, that the z axis of a mesh is turned to by mesh.direction or mesh.euler_angles:
/// the axis of symmetry of the shapes that the program makes.
Eigen::Vector3d mesh_axis(const MeshCase& mesh);

}  // namespace tanktread::driver
