#include "fluid/d3q19.hpp"
#include "fluid/settings.hpp"

namespace tanktread::fluid {

DevelopedFlow developed_flow(const LatticeBoltzmannSettings& settings, int x, int y, int z) {
  DevelopedFlow flow;
  if (!settings.walls) return flow;
  const auto& walls = *settings.walls;
  const std::array<int, 3> node = {x, y, z};
  const std::array<int, 3> nodes = {settings.shape.nx, settings.shape.ny, settings.shape.nz};
  const double height = nodes[walls.axis];
  const double s = node[walls.axis] + 0.5;
  const double viscosity = (settings.relaxation_time - 0.5) / d3q19::inverse_sound_speed_squared;
  for (int component = 0; component < 3; ++component) {
    if (component == walls.axis) continue;
    const double low = walls.low_velocity[component], high = walls.high_velocity[component];
    const double curvature = settings.body_force[component] / (2.0 * viscosity);  // u'' = -F/nu
    flow.velocity[component] = low + (high - low) * s / height + curvature * s * (height - s);
    flow.gradient[component] = (high - low) / height + curvature * (height - 2.0 * s);
  }
  return flow;
}

std::array<double, 19> start_populations(const LatticeBoltzmannSettings& settings, int x, int y, int z) {
  std::array<double, 19> populations{};
  if (settings.start == Start::rest) return populations;
  const auto flow = developed_flow(settings, x, y, z);
  const auto& u = flow.velocity;
  const auto& force = settings.body_force;
  const int axis = settings.walls->axis;
  const double quadratic = settings.inertia ? 1.0 : 0.0;
  const double u_squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  // Of the departure -3 w tau+ c c : grad u the collision leaves the share 1 - 1/tau+. It leaves of the force
  // the momentum F/2 on top of u (velocity() takes it off again).
  const double departure = -3.0 * (settings.relaxation_time - 1.0);
  for (int i = 0; i < d3q19::n_directions; ++i) {
    const auto& c = d3q19::velocity[i];
    const double cu = c[0] * u[0] + c[1] * u[1] + c[2] * u[2];
    const double c_gradient = c[0] * flow.gradient[0] + c[1] * flow.gradient[1] + c[2] * flow.gradient[2];
    const double c_force = c[0] * force[0] + c[1] * force[1] + c[2] * force[2];
    populations[i] = d3q19::weight(i) * (3.0 * cu + quadratic * (4.5 * cu * cu - 1.5 * u_squared) +
                                         departure * c[axis] * c_gradient + 1.5 * c_force);
  }
  return populations;
}

}  // namespace tanktread::fluid
