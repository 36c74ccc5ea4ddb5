// Capsules, errors and surfaces in messages between ranks. Internal to driver/engine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "driver/engine/system_part.hpp"
#include "driver/system/pack_matrix.hpp"
#include "exchange/packet.hpp"

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

inline void pack(ranks::Packing& packing, const PartCapsule& capsule) {
  packing.put(capsule.number);
  pack_matrix(packing, capsule.start.points);
  pack_matrix(packing, capsule.start.triangles);
  pack_matrix(packing, capsule.stress_free);
  packing.put(capsule.state.has_value());
  if (!capsule.state) return;
  for (const auto* matrix : {&capsule.state->positions, &capsule.state->velocity, &capsule.state->force})
    pack_matrix(packing, *matrix);
  packing.put_all(capsule.state->history);
}
inline PartCapsule take_capsule(ranks::Unpacking& unpacking) {
  PartCapsule capsule;
  capsule.number = unpacking.take<std::size_t>();
  take_matrix(unpacking, capsule.start.points);
  take_matrix(unpacking, capsule.start.triangles);
  take_matrix(unpacking, capsule.stress_free);
  if (!unpacking.take<bool>()) return capsule;
  auto& state = capsule.state.emplace();
  for (auto* matrix : {&state.positions, &state.velocity, &state.force}) take_matrix(unpacking, *matrix);
  state.history = unpacking.take_all<double>();
  return capsule;
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

inline void pack(ranks::Packing& packing, const std::vector<exchange::Array>& arrays) {
  packing.put(arrays.size());
  for (const auto& array : arrays) packing.put_text(array.name).put(array.components).put_all(array.values);
}
inline std::vector<exchange::Array> take_arrays(ranks::Unpacking& unpacking) {
  std::vector<exchange::Array> arrays(unpacking.take<std::size_t>());
  for (auto& array : arrays) {
    array.name = unpacking.take_text();
    array.components = unpacking.take<int>();
    array.values = unpacking.take_all<double>();
  }
  return arrays;
}

inline void pack(ranks::Packing& packing, const exchange::SurfacePacket& surface) {
  packing.put_all(surface.points).put_all(surface.triangles);
  for (const auto* arrays : {&surface.point_data, &surface.cell_data, &surface.field_data})
    pack(packing, *arrays);
}
inline exchange::SurfacePacket take_surface(ranks::Unpacking& unpacking) {
  exchange::SurfacePacket surface;
  surface.points = unpacking.take_all<double>();
  surface.triangles = unpacking.take_all<std::int64_t>();
  for (auto* arrays : {&surface.point_data, &surface.cell_data, &surface.field_data})
    *arrays = take_arrays(unpacking);
  return surface;
}

}  // namespace tanktread::driver
