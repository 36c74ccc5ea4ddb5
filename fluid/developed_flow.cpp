#include "fluid/developed_flow.hpp"

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
  const double viscosity = viscosity_of(settings);
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
  const bool developed = settings.start == Start::developed;
  const int axis = developed ? settings.walls->axis : 0;
  const auto flow = developed ? developed_flow(settings, x, y, z) : DevelopedFlow{};
  const auto& u = flow.velocity;
  const auto& force = settings.body_force;
  const double inertia = settings.inertia ? 1.0 : 0.0;
  const double u_squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  const double u_force = u[0] * force[0] + u[1] * force[1] + u[2] * force[2];
  // A collision leaves the momentum F/2 on top of u (velocity() takes it off again), and of a departure from
  // equilibrium the share 1 - 1/tau. The departures are, with s along the wall axis,
  //   even: -3 w tau+ c_s c.u',   odd, where u'' = -F/nu: -3 w tau- c.F (3 c_s^2 - 1).
  const double even_departure = -3.0 * (settings.relaxation_time - 1.0);
  const double odd_departure = -3.0 * (odd_relaxation_time(settings, settings.relaxation_time) - 1.0);
  std::array<double, 19> populations{};
  for (int i = 0; i < d3q19::n_directions; ++i) {
    const auto& c = d3q19::velocity[i];
    const double cu = c[0] * u[0] + c[1] * u[1] + c[2] * u[2];
    const double c_gradient = c[0] * flow.gradient[0] + c[1] * flow.gradient[1] + c[2] * flow.gradient[2];
    const double c_force = c[0] * force[0] + c[1] * force[1] + c[2] * force[2];
    double population = 3.0 * cu + inertia * (4.5 * cu * cu - 1.5 * u_squared) +
                        0.5 * (3.0 * c_force + inertia * (9.0 * cu * c_force - 3.0 * u_force));
    if (developed) {
      const double c_force_along = c_force - c[axis] * force[axis];
      population += even_departure * c[axis] * c_gradient +
                    odd_departure * c_force_along * (3.0 * c[axis] * c[axis] - 1.0);
    }
    populations[i] = d3q19::weight(i) * population;
  }
  return populations;
}

}  // namespace tanktread::fluid
