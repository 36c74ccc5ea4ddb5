// What each rank says of its capsules and its block when the first one asks, and how it travels. Internal to
// driver/engine.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "driver/engine/capsule_orders.hpp"
#include "driver/observe/energy.hpp"
#include "driver/observe/observables.hpp"

namespace tanktread::driver {

/// A row of measures.csv.
struct CapsuleRow {
  std::size_t capsule = 0;
  std::string text;
};
std::vector<CapsuleRow> measures_rows(const SystemPart& part);

inline void pack(ranks::Packing& packing, const std::vector<CapsuleRow>& rows) {
  packing.put(rows.size());
  for (const auto& row : rows) packing.put(row.capsule).put_text(row.text);
}
inline std::vector<CapsuleRow> take_rows(ranks::Unpacking& unpacking) {
  std::vector<CapsuleRow> rows(unpacking.take<std::size_t>());
  for (auto& row : rows) {
    row.capsule = unpacking.take<std::size_t>();
    row.text = unpacking.take_text();
  }
  return rows;
}

/// Observations are sent as they lie in memory.
static_assert(std::is_trivially_copyable_v<Observation>);

/// What a rank adds to the budget of the energy.
struct PartEnergy {
  std::optional<StepError> error;  ///< of the tangential correction: the rest is of no use then
  std::vector<std::pair<std::size_t, MembraneBudget>> membranes;  ///< with their numbers in the case
  FlowBudget flow;
};
/// Together. @param fluid the rank's part
PartEnergy energy_of(SystemPart& part, const fluid::Fluid& fluid);

void pack(ranks::Packing& packing, const PartEnergy& energy);
PartEnergy take_energy(ranks::Unpacking& unpacking);

}  // namespace tanktread::driver
