// Capsules and errors in messages between the first rank and the others. Internal to driver/system.
#pragma once

#include <optional>
#include <vector>

#include "driver/system/pack_matrix.hpp"
#include "driver/system/system_part.hpp"

namespace tanktread::driver {

/// What Order::make_system takes with it: the case as text, which says all, to the last bit.
inline void pack(ranks::Packing& packing, const Case& the_case) {
  packing.put_text(to_toml(the_case)).put_text(the_case.file.string());
}
inline Case take_case(ranks::Unpacking& unpacking) {
  const auto text = unpacking.take_text();
  const auto name = unpacking.take_text();
  return parse_case(text, name, std::filesystem::absolute(name).parent_path(), {}, {false, false, false});
}

inline void pack(ranks::Packing& packing, const std::vector<CapsuleState>& states) {
  packing.put(states.size());
  for (const auto& state : states) {
    packing.put(state.number);
    for (const auto* matrix : {&state.positions, &state.velocity, &state.force})
      pack_matrix(packing, *matrix);
    packing.put_all(state.history);
  }
}
inline std::vector<CapsuleState> take_states(ranks::Unpacking& unpacking) {
  std::vector<CapsuleState> states(unpacking.take<std::size_t>());
  for (auto& state : states) {
    state.number = unpacking.take<std::size_t>();
    for (auto* matrix : {&state.positions, &state.velocity, &state.force}) take_matrix(unpacking, *matrix);
    state.history = unpacking.take_all<double>();
  }
  return states;
}

/// What Order::take_capsules takes with it.
struct CapsulesTaken {
  std::int64_t step = 0;
  std::vector<CapsuleState> states;
  MembraneShapes shapes;  ///< one a state
};

inline void pack(ranks::Packing& packing, const CapsulesTaken& capsules) {
  packing.put(capsules.step);
  pack(packing, capsules.states);
  for (std::size_t k = 0; k < capsules.states.size(); ++k) {
    pack_matrix(packing, capsules.shapes.meshes[k].points);
    pack_matrix(packing, capsules.shapes.meshes[k].triangles);
    pack_matrix(packing, capsules.shapes.stress_free[k]);
  }
}
inline CapsulesTaken take_capsules(ranks::Unpacking& unpacking) {
  CapsulesTaken capsules;
  capsules.step = unpacking.take<std::int64_t>();
  capsules.states = take_states(unpacking);
  capsules.shapes.meshes.resize(capsules.states.size());
  capsules.shapes.stress_free.resize(capsules.states.size());
  for (std::size_t k = 0; k < capsules.states.size(); ++k) {
    take_matrix(unpacking, capsules.shapes.meshes[k].points);
    take_matrix(unpacking, capsules.shapes.meshes[k].triangles);
    take_matrix(unpacking, capsules.shapes.stress_free[k]);
  }
  return capsules;
}

/// The error of a rank, or that it has none.
inline ranks::Packing packed(const std::optional<StepError>& error) {
  ranks::Packing packing;
  packing.put(error.has_value());
  if (error) pack(packing, *error);
  return packing;
}
inline std::optional<StepError> take_error(ranks::Unpacking& unpacking) {
  if (!unpacking.take<bool>()) return std::nullopt;
  return take_step_error(unpacking);
}

}  // namespace tanktread::driver
