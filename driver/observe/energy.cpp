#include "driver/observe/energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "driver/system/components.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

double power_of(const Eigen::Matrix3Xd& force, const Eigen::Matrix3Xd& velocity) {
  return force.cwiseProduct(velocity).sum();
}

void add_membranes(const System& system, EnergyBudget& budget) {
  const auto on_grid = grid_velocity(*system.fluid, system.coupler->grid_node_list());
  const auto surfaces = surfaces_of(system.membranes);
  const auto interpolated = interpolated_velocity(*system.coupler, on_grid, surfaces.positions);
  auto velocity = interpolated;
  correct_velocity(*system.coupler, system.corrections, surfaces, system.node_force, velocity);
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    const auto& membrane = system.membranes[k];
    const auto viscous = membrane.viscous_power(velocity[k]);
    budget.elastic_energy += membrane.elastic_energy();
    budget.load_power += power_of(membrane.load_at(system.step), velocity[k]);
    budget.elastic_power -= power_of(membrane.elastic_forces(), velocity[k]);
    for (auto& term : budget.terms) {
      term.energy += membrane.term_energy(term.name);
      term.power -= power_of(membrane.term_forces(term.name), velocity[k]);
    }
    budget.viscous_shear += viscous.shear;
    budget.viscous_dilatational += viscous.dilatational;
    budget.spring_power += viscous.spring;
    budget.correction += power_of(system.node_force[k], velocity[k] - interpolated[k]);
  }
}

/// Which nodes are inside, also where the fluid has one viscosity and the run need not know. Nothing where
/// surfaces that overlap leave no answer.
std::vector<std::int32_t> marks_now(const System& system, const Case& the_case) {
  if (system.inside) return {system.inside->marks().begin(), system.inside->marks().end()};
  coupler::InsideMarks marks(coupler_grid(the_case), system.threads);
  const auto surfaces = surfaces_of(system.membranes);
  try {
    mark_inside(marks, surfaces.positions, surfaces.triangles, true);
  } catch (const coupler::InsideError&) {
    return {};
  }
  return {marks.marks().begin(), marks.marks().end()};
}

void add_dissipation(const System& system, const Case& the_case, EnergyBudget& budget) {
  std::vector<double> power(static_cast<std::size_t>(system.fluid->shape().size()));
  system.fluid->dissipation(power);
  const auto marks = marks_now(system, the_case);
  for (std::size_t node = 0; node < power.size(); ++node)
    (!marks.empty() && marks[node] > 0 ? budget.inner : budget.outer) += power[node];
  if (marks.empty()) budget.inner = std::numeric_limits<double>::quiet_NaN();
}

/// What the dissipation inside takes off the budget: where it is not known apart, it is in that outside.
double known(double inner) {
  return std::isnan(inner) ? 0 : inner;
}

void add_flow(const System& system, const Case& the_case, EnergyBudget& budget) {
  const auto n_nodes = static_cast<std::size_t>(system.fluid->shape().size());
  std::vector<double> density(n_nodes), velocity(3 * n_nodes);
  system.fluid->moments(density, velocity);
  const auto body_force = flow_parameters(the_case).body_force;
  for (std::size_t node = 0; node < n_nodes; ++node) {
    const double* u = &velocity[3 * node];
    budget.kinetic_energy +=
        0.5 * (the_case.flow.inertia ? density[node] : 1.0) * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    budget.body_force += body_force[0] * u[0] + body_force[1] * u[1] + body_force[2] * u[2];
  }
}

double power_of_walls(const fluid::Fluid& fluid) {
  std::vector<double> power(static_cast<std::size_t>(fluid.shape().size()));
  fluid.wall_power(power);
  return std::accumulate(power.begin(), power.end(), 0.0);
}

/// Of the next time, under the present force: u = u_free + mobility F, mobility = 1/(2 rho). Plane by plane,
/// which takes little memory.
double next_kinetic_energy(const fluid::Fluid& fluid) {
  const auto shape = fluid.shape();
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(shape.size() / shape.nz));
  std::vector<double> velocity(3 * nodes.size()), mobility(nodes.size());
  const auto force = fluid.force();
  double energy = 0;
  for (int z = 0; z < shape.nz; ++z) {
    std::iota(nodes.begin(), nodes.end(), shape.index(0, 0, z));
    fluid.free_velocity(nodes, velocity, mobility);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (std::size_t component = 0; component < 3; ++component) {
        const double u = velocity[3 * k + component] +
                         mobility[k] * force[3 * static_cast<std::size_t>(nodes[k]) + component];
        energy += u * u / (4 * mobility[k]);
      }
    }
  }
  return energy;
}

}  // namespace

EnergyBudget energy_budget(const System& system, const Case& the_case) {
  EnergyBudget budget;
  budget.step = system.step;
  budget.shear_time = system.shear_time();
  for (const auto& name : term_names(system.membranes)) budget.terms.push_back({name});
  add_membranes(system, budget);
  add_dissipation(system, the_case, budget);
  add_flow(system, the_case, budget);
  budget.walls = power_of_walls(*system.fluid);
  const double kinetic_rate = next_kinetic_energy(*system.fluid) - budget.kinetic_energy;
  budget.remainder = budget.walls + budget.body_force + budget.load_power - budget.elastic_power -
                     budget.viscous_shear - budget.viscous_dilatational - budget.spring_power -
                     known(budget.inner) - budget.outer - budget.correction - kinetic_rate;
  for (const auto& term : budget.terms) budget.remainder -= term.power;
  return budget;
}

std::string energy_header(const std::vector<std::string>& terms) {
  std::string header =
      "step,shear_time,elastic_energy,elastic_power,viscous_shear,viscous_dilatational,spring_power,inner,"
      "outer,walls,body_force,correction,kinetic_energy,remainder,load_power";
  for (const auto& term : terms) header += fmt::format(",{0}_energy,{0}_power", name_in_files(term));
  return header + "\n";
}

std::string energy_row(const EnergyBudget& b) {
  std::string row = fmt::format("{}", b.step);
  for (const double value : {b.shear_time, b.elastic_energy, b.elastic_power, b.viscous_shear,
                             b.viscous_dilatational, b.spring_power, b.inner, b.outer, b.walls, b.body_force,
                             b.correction, b.kinetic_energy, b.remainder, b.load_power}) {
    row += fmt::format(",{:.17g}", value);
  }
  for (const auto& term : b.terms) row += fmt::format(",{:.17g},{:.17g}", term.energy, term.power);
  return row + "\n";
}

}  // namespace tanktread::driver
