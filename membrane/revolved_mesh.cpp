#include "membrane/revolved_mesh.hpp"

#include <cmath>
#include <numbers>

namespace tanktread::membrane {

TriangleMesh revolved_mesh(const Meridian& meridian, int level) {
  auto mesh = icosphere(level, 1);
  const MeridianLength length(meridian);
  for (auto node : mesh.points.colwise()) {
    const double from_axis = std::hypot(node[0], node[1]), height = node[2];
    const double share = std::atan2(from_axis, std::abs(height)) / (0.5 * std::numbers::pi);
    const auto [rho, z] = point_at(meridian, length.parameter_at(share));
    const double outwards = from_axis > 0 ? rho / from_axis : 0;
    node *= outwards;
    node[2] = height == 0 ? 0 : std::copysign(z, height);  // on the rim z is but rounded to 0
  }
  return mesh;
}

}  // namespace tanktread::membrane
