#include "driver/engine/part_answers.hpp"

#include "driver/observe/measures.hpp"

namespace tanktread::driver {
namespace {

FlowBudget flow_of(SystemPart& part, const fluid::Fluid& fluid) {
  std::vector<std::int32_t> marks;
  try {
    marks = part.marks_now();
  } catch (const coupler::InsideError&) {
    return flow_budget(fluid, std::nullopt, part.the_case(), part.threads());
  }
  return flow_budget(fluid, marks, part.the_case(), part.threads());
}

constexpr double MembraneBudget::*numbers_of_membrane[] = {
    &MembraneBudget::elastic_energy, &MembraneBudget::elastic_power,
    &MembraneBudget::viscous_shear,  &MembraneBudget::viscous_dilatational,
    &MembraneBudget::spring_power,   &MembraneBudget::correction,
    &MembraneBudget::load_power};

}  // namespace

std::vector<CapsuleRow> measures_rows(const SystemPart& part) {
  std::vector<CapsuleRow> rows;
  for (const auto& row : measure(part.capsules(), part.the_case()))
    rows.push_back({static_cast<std::size_t>(row.capsule), measures_row(row)});
  return rows;
}

PartEnergy energy_of(SystemPart& part, const fluid::Fluid& fluid) {
  PartEnergy energy;
  FirstError error;
  const auto velocities = part.node_velocities(error);
  const auto capsules = part.capsules();
  auto budgets =
      membrane_budgets(capsules, velocities.interpolated, velocities.corrected, part.arrays().terms);
  for (std::size_t k = 0; k < budgets.size(); ++k)
    energy.membranes.emplace_back(capsules.number(k), std::move(budgets[k]));
  energy.flow = flow_of(part, fluid);
  energy.error = error.error();
  return energy;
}

void pack(ranks::Packing& packing, const PartEnergy& energy) {
  packing.put(energy.error.has_value());
  if (energy.error) pack(packing, *energy.error);
  packing.put(energy.membranes.size());
  for (const auto& [number, budget] : energy.membranes) {
    packing.put(number);
    for (const auto member : numbers_of_membrane) packing.put(budget.*member);
    packing.put(budget.terms.size());
    for (const auto& term : budget.terms) packing.put_text(term.name).put(term.energy).put(term.power);
  }
  static_assert(std::is_trivially_copyable_v<FlowBudget>);
  packing.put(energy.flow);
}

PartEnergy take_energy(ranks::Unpacking& unpacking) {
  PartEnergy energy;
  energy.error = take_error(unpacking);
  energy.membranes.resize(unpacking.take<std::size_t>());
  for (auto& [number, budget] : energy.membranes) {
    number = unpacking.take<std::size_t>();
    for (const auto member : numbers_of_membrane) budget.*member = unpacking.take<double>();
    budget.terms.resize(unpacking.take<std::size_t>());
    for (auto& term : budget.terms) {
      term.name = unpacking.take_text();
      term.energy = unpacking.take<double>();
      term.power = unpacking.take<double>();
    }
  }
  energy.flow = unpacking.take<FlowBudget>();
  return energy;
}

}  // namespace tanktread::driver
