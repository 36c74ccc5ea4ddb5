#include "driver/observe/energy.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "driver/system/components.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

double power_of(const Eigen::Matrix3Xd& force, const Eigen::Matrix3Xd& velocity) {
  return force.cwiseProduct(velocity).sum();
}

std::vector<MembraneBudget> membrane_budgets(const System& system) {
  const auto on_grid = grid_velocity(*system.fluid, system.coupler->grid_node_list());
  const auto surfaces = surfaces_of(system.membranes);
  const auto interpolated = interpolated_velocity(*system.coupler, on_grid, surfaces.positions);
  auto velocity = interpolated;
  correct_velocity(*system.coupler, system.corrections, surfaces, system.node_force, velocity);
  return membrane_budgets(capsules_now(system), interpolated, velocity, term_names(system.membranes));
}

/// Which nodes are inside, also where the fluid has one viscosity and the run need not know. Nothing where
/// surfaces that overlap leave no answer.
FlowBudget flow_budget(const System& system, const Case& the_case) {
  if (system.inside) return flow_budget(*system.fluid, system.inside->marks(), the_case, system.threads);
  coupler::InsideMarks marks(coupler_grid(the_case), system.threads);
  const auto surfaces = surfaces_of(system.membranes);
  try {
    mark_inside(marks, surfaces.positions, surfaces.triangles, true);
  } catch (const coupler::InsideError&) {
    return flow_budget(*system.fluid, std::nullopt, the_case, system.threads);
  }
  return flow_budget(*system.fluid, marks.marks(), the_case, system.threads);
}

}  // namespace

std::vector<MembraneBudget> membrane_budgets(const CapsulesNow& capsules,
                                             std::span<const Eigen::Matrix3Xd> interpolated,
                                             std::span<const Eigen::Matrix3Xd> velocity,
                                             const std::vector<std::string>& terms) {
  std::vector<MembraneBudget> budgets;
  for (std::size_t k = 0; k < capsules.membranes.size(); ++k) {
    const auto& membrane = capsules.membranes[k];
    const auto viscous = membrane.viscous_power(velocity[k]);
    MembraneBudget budget;
    budget.elastic_energy = membrane.elastic_energy();
    budget.load_power = power_of(membrane.load_at(capsules.step), velocity[k]);
    budget.elastic_power = -power_of(membrane.elastic_forces(), velocity[k]);
    for (const auto& name : terms) {
      budget.terms.push_back(
          {name, membrane.term_energy(name), -power_of(membrane.term_forces(name), velocity[k])});
    }
    budget.viscous_shear = viscous.shear;
    budget.viscous_dilatational = viscous.dilatational;
    budget.spring_power = viscous.spring;
    budget.correction = power_of(capsules.force[k], velocity[k] - interpolated[k]);
    budgets.push_back(std::move(budget));
  }
  return budgets;
}

EnergyBudget energy_budget(std::int64_t step, double shear_time, const std::vector<MembraneBudget>& membranes,
                           const FlowBudget& flow) {
  EnergyBudget budget;
  budget.step = step;
  budget.shear_time = shear_time;
  for (const auto& membrane : membranes) {
    budget.elastic_energy += membrane.elastic_energy;
    budget.elastic_power += membrane.elastic_power;
    budget.viscous_shear += membrane.viscous_shear;
    budget.viscous_dilatational += membrane.viscous_dilatational;
    budget.spring_power += membrane.spring_power;
    budget.correction += membrane.correction;
    budget.load_power += membrane.load_power;
    for (std::size_t k = 0; k < membrane.terms.size(); ++k) {
      if (k == budget.terms.size()) budget.terms.push_back({membrane.terms[k].name});
      budget.terms[k].energy += membrane.terms[k].energy;
      budget.terms[k].power += membrane.terms[k].power;
    }
  }
  budget.inner = flow.inner.value();
  budget.outer = flow.outer.value();
  budget.walls = flow.walls.value();
  budget.body_force = flow.body_force.value();
  budget.kinetic_energy = flow.kinetic_energy.value();
  const double kinetic_rate = flow.next_kinetic_energy.value() - budget.kinetic_energy;
  budget.remainder = budget.walls + budget.body_force + budget.load_power - budget.elastic_power -
                     budget.viscous_shear - budget.viscous_dilatational - budget.spring_power - budget.inner -
                     budget.outer - budget.correction - kinetic_rate;
  for (const auto& term : budget.terms) budget.remainder -= term.power;
  if (!flow.knows_inside) budget.inner = std::numeric_limits<double>::quiet_NaN();
  return budget;
}

EnergyBudget energy_budget(const System& system, const Case& the_case) {
  return energy_budget(system.step, system.shear_time(), membrane_budgets(system),
                       flow_budget(system, the_case));
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
