// What the flow has and takes up of the energy of a system.
#include <numeric>
#include <vector>

#include "driver/observe/energy.hpp"
#include "driver/units/flow_units.hpp"
#include "fluid/layer_ranges.hpp"

namespace tanktread::driver {
namespace {

void add_dissipation(const fluid::Fluid& fluid, std::optional<std::span<const std::int32_t>> marks,
                     int threads, FlowBudget& budget) {
  const auto n = fluid.shape().size();
  std::vector<double> power(static_cast<std::size_t>(n));
  fluid.dissipation(power);
  budget.knows_inside = marks.has_value();
  const auto is_inside = [&](std::size_t node) { return marks && (*marks)[node] > 0; };
  const auto of = [&](bool inside) {
    return exact_sum(n, threads, [&, inside](std::int64_t k) {
      const auto node = static_cast<std::size_t>(k);
      return is_inside(node) == inside ? power[node] : 0.0;
    });
  };
  budget.outer = of(false);
  budget.inner = of(true);
}

/// Some layers at a time, for densities and velocities of all nodes take a fifth of the memory of a fluid.
void add_flow(const fluid::Fluid& fluid, const Case& the_case, int threads, FlowBudget& budget) {
  const auto shape = fluid.shape();
  const auto body_force = flow_parameters(the_case).body_force;
  const bool has_inertia = the_case.flow.inertia;
  std::vector<double> density, velocity;
  const std::int64_t nodes_a_layer = std::int64_t{shape.nx} * shape.ny;
  fluid::for_layer_ranges(nodes_a_layer, shape.nz, 4, [&](fluid::Layers layers) {
    const std::int64_t n = nodes_a_layer * (layers.end - layers.begin);
    density.resize(static_cast<std::size_t>(n));
    velocity.resize(3 * density.size());
    fluid.moments_of_layers(layers, density, velocity);
    budget.kinetic_energy.add(exact_sum(n, threads, [&](std::int64_t k) {
      const auto node = static_cast<std::size_t>(k);
      const double* u = &velocity[3 * node];
      return 0.5 * (has_inertia ? density[node] : 1.0) * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    }));
    budget.body_force.add(exact_sum(n, threads, [&](std::int64_t k) {
      const double* u = &velocity[3 * static_cast<std::size_t>(k)];
      return body_force[0] * u[0] + body_force[1] * u[1] + body_force[2] * u[2];
    }));
  });
}

void add_walls(const fluid::Fluid& fluid, int threads, FlowBudget& budget) {
  std::vector<double> power(static_cast<std::size_t>(fluid.shape().size()));
  fluid.wall_power(power);
  budget.walls = exact_sum(fluid.shape().size(), threads,
                           [&](std::int64_t k) { return power[static_cast<std::size_t>(k)]; });
}

/// Under the present force: u = u_free + mobility F, mobility = 1/(2 rho). Plane by plane, which takes little
/// memory.
void add_next_kinetic_energy(const fluid::Fluid& fluid, FlowBudget& budget) {
  const auto shape = fluid.shape();
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(shape.size() / shape.nz));
  std::vector<double> velocity(3 * nodes.size()), mobility(nodes.size());
  const auto force = fluid.force();
  for (int z = 0; z < shape.nz; ++z) {
    std::iota(nodes.begin(), nodes.end(), shape.index(0, 0, z));
    fluid.free_velocity(nodes, velocity, mobility);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      double square = 0;
      for (std::size_t component = 0; component < 3; ++component) {
        const double u = velocity[3 * k + component] +
                         mobility[k] * force[3 * static_cast<std::size_t>(nodes[k]) + component];
        square += u * u;
      }
      budget.next_kinetic_energy.add(square / (4 * mobility[k]));
    }
  }
}

}  // namespace

void FlowBudget::add(const FlowBudget& other) {
  for (auto sum : {&FlowBudget::inner, &FlowBudget::outer, &FlowBudget::walls, &FlowBudget::body_force,
                   &FlowBudget::kinetic_energy, &FlowBudget::next_kinetic_energy})
    (this->*sum).add(other.*sum);
  knows_inside = knows_inside && other.knows_inside;
  if (knows_inside) return;
  outer.add(inner);  // to which of them a node belongs is not known then
  inner = {};
}

FlowBudget flow_budget(const fluid::Fluid& fluid, std::optional<std::span<const std::int32_t>> marks,
                       const Case& the_case, int threads) {
  FlowBudget budget;
  add_dissipation(fluid, marks, threads, budget);
  add_flow(fluid, the_case, threads, budget);
  add_walls(fluid, threads, budget);
  add_next_kinetic_energy(fluid, budget);
  return budget;
}

}  // namespace tanktread::driver
