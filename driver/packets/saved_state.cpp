#include "driver/packets/saved_state.hpp"

#include <fmt/format.h>

#include "driver/packets/packet_files.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

void read_membranes(const std::filesystem::path& file, SavedState& state) {
  const auto content = exchange::read_surface(file);
  const auto name = file.string();
  auto surfaces = surfaces_of(content, name);
  state.shapes = shapes_of(content, surfaces, name);
  for (std::size_t k = 0; k < state.shapes.meshes.size(); ++k)
    state.membranes.push_back(membrane_state_of(content, k, name));
  state.node_velocity = vectors_of(content, "velocity", surfaces, name);
  state.node_force = vectors_of(content, "total_force", surfaces, name);
  state.positions = std::move(surfaces.positions);
  if (step_of(content.field_data, name) != state.step) {
    throw exchange::FileError(fmt::format("{}: of step {}, the fluid beside it of step {}", name,
                                          step_of(content.field_data, name), state.step));
  }
}

/// Of pieces the index alone.
void read_fluid(const std::filesystem::path& folder, SavedState& state) {
  const auto file = folder / fluid_state_file, index_file = folder / fluid_state_index;
  if (!std::filesystem::exists(index_file)) {
    state.fluid = state_of(exchange::read_grid(file), file.string());
    return;
  }
  const auto index = exchange::read_grid_index(index_file);
  check_schema_version(index.field_data, index_file.string());
  state.fluid.step = step_of(index.field_data, index_file.string());
  state.fluid_pieces = index_file;
}

std::vector<exchange::Array> program_arrays_of(const exchange::SurfacePacket& file,
                                               const std::string& prefix) {
  std::vector<exchange::Array> arrays;
  for (const auto& array : file.field_data) {
    if (array.name.starts_with(prefix))
      arrays.push_back({array.name.substr(prefix.size()), array.components, array.values});
  }
  return arrays;
}

}  // namespace

std::optional<Case> read_state_case(const std::filesystem::path& folder) {
  const auto file = folder / case_state_file;
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return read_case(file, {}, {false, false, false});
  } catch (const InputError& error) {
    throw exchange::FileError(error.what());
  }
}

SavedState read_state(const std::filesystem::path& folder) {
  SavedState state;
  state.folder = folder;
  read_fluid(folder, state);
  state.step = state.fluid.step;
  read_membranes(folder / membrane_state_file, state);
  state.the_case = read_state_case(folder);
  return state;
}

fluid::State state_of(exchange::GridPacket file, const std::string& name) {
  check_schema_version(file.field_data, name);
  fluid::State state;
  state.step = step_of(file.field_data, name);
  for (auto& array : file.point_data)
    state.arrays.push_back({array.name, array.components, std::move(array.values)});
  return state;
}

MembraneShapes shapes_of(const exchange::SurfacePacket& file, const Surfaces& surfaces,
                         const std::string& name) {
  MembraneShapes shapes;
  shapes.stress_free = vectors_of(file, reference_array, surfaces, name);
  const bool starts_elsewhere = exchange::find_optional_array(file.point_data, start_array) != nullptr;
  auto starts = starts_elsewhere ? vectors_of(file, start_array, surfaces, name) : shapes.stress_free;
  for (std::size_t k = 0; k < starts.size(); ++k)
    shapes.meshes.push_back({std::move(starts[k]), surfaces.triangles[k]});
  return shapes;
}

std::string history_name(std::size_t capsule) {
  return fmt::format("history_{}", capsule);
}

std::string program_prefix(std::size_t capsule, const char* kind) {
  return fmt::format("program_{}_{}_", capsule, kind);
}

MembraneState membrane_state_of(const exchange::SurfacePacket& file, std::size_t capsule,
                                const std::string& name) {
  return {exchange::find_array(file.field_data, history_name(capsule), name).values,
          {program_arrays_of(file, program_prefix(capsule, "point")),
           program_arrays_of(file, program_prefix(capsule, "cell"))}};
}

}  // namespace tanktread::driver
