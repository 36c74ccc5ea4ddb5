#include "driver/units/mesh_axis.hpp"

#include <cmath>
#include <numbers>

namespace tanktread::driver {

Eigen::Vector3d mesh_axis(const MeshCase& mesh) {
  if (mesh.direction) {
    const auto& to = *mesh.direction;
    return Eigen::Vector3d(to[0], to[1], to[2]).stableNormalized();
  }
  if (!mesh.euler_angles) return Eigen::Vector3d::UnitZ();
  // The turn about the new x tilts z, the one about z before it says where to; the last one is about it.
  const double first = (*mesh.euler_angles)[0] * std::numbers::pi / 180;
  const double second = (*mesh.euler_angles)[1] * std::numbers::pi / 180;
  return {std::sin(first) * std::sin(second), -std::cos(first) * std::sin(second), std::cos(second)};
}

}  // namespace tanktread::driver
