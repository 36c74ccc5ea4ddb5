// What is said of a step that broke down. Internal to fluid/.
#pragma once

#include <cmath>
#include <cstdint>
#include <sstream>

#include "fluid/halo.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "fluid/node_moments.hpp"

namespace tanktread::fluid {

/// Looks for the node that broke down in a row that a step has just written. Nodes are named by their place
/// in the whole box.
/// @param row of the part, z ny + y @throws Breakdown
template <typename Real>
[[noreturn]] void throw_breakdown(MomentReader<Real>& reader, const LatticeBoltzmannSettings& settings,
                                  const GridPart& part, std::int64_t step, std::int64_t row) {
  const int y = static_cast<int>(row % part.shape.ny), z = static_cast<int>(row / part.shape.ny);
  const auto& begin = part.begin;
  const auto in_box = [&](int x) { return settings.shape.index(begin[0] + x, begin[1] + y, begin[2] + z); };
  std::ostringstream message;
  message << "step " << step << ": ";
  for (int x = 0; x < part.shape.nx; ++x) {
    const auto moments = reader.at(part.shape.index(x, y, z));
    const auto& u = moments.velocity;
    const double speed = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    if (speed < settings.speed_limit) continue;
    message << "the fluid velocity at node (" << begin[0] + x << ", " << begin[1] + y << ", " << begin[2] + z
            << ") is (" << u[0] << ", " << u[1] << ", " << u[2] << "), density " << moments.density << "; "
            << (std::isfinite(speed) ? "its speed is over speed_limit, "
                                     : "it must be finite and its speed below speed_limit, ")
            << settings.speed_limit;
    throw Breakdown(message.str(), in_box(x));
  }
  message << "the fluid speed reached speed_limit, " << settings.speed_limit << " in row y = " << begin[1] + y
          << ", z = " << begin[2] + z;
  throw Breakdown(message.str(), in_box(0));
}

}  // namespace tanktread::fluid
