#include "driver/packets/saved_state.hpp"

#include <fmt/format.h>

#include "driver/packets/packet_files.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// Counts the capsules of a piece from 0. @return the number that the first one had
std::size_t take_first_number(exchange::SurfacePacket& content) {
  constexpr double most = 1e9;
  for (auto& array : content.cell_data) {
    if (array.name != "capsule" || array.values.empty()) continue;
    const double first = array.values.front();
    if (!(first >= 0 && first < most)) return 0;  // no number of a capsule, as will be said
    for (double& number : array.values) number -= first;
    return static_cast<std::size_t>(first);
  }
  return 0;
}

SavedCapsules saved_capsules(const exchange::SurfacePacket& content, std::size_t first,
                             const std::string& name) {
  SavedCapsules saved;
  saved.first = first;
  auto surfaces = surfaces_of(content, name);
  saved.shapes = shapes_of(content, surfaces, name);
  for (std::size_t k = 0; k < saved.shapes.meshes.size(); ++k)
    saved.membranes.push_back(membrane_state_of(content, saved.first + k, name));
  saved.node_velocity = vectors_of(content, "velocity", surfaces, name);
  saved.node_force = vectors_of(content, "total_force", surfaces, name);
  saved.positions = std::move(surfaces.positions);
  return saved;
}

void require_step(const std::vector<exchange::Array>& field_data, std::int64_t step,
                  const std::string& name) {
  if (step_of(field_data, name) == step) return;
  throw exchange::FileError(
      fmt::format("{}: of step {}, the fluid beside it of step {}", name, step_of(field_data, name), step));
}

/// Of pieces the index alone, unless they are asked for.
void read_membranes(const std::filesystem::path& folder, bool with_pieces, SavedState& state) {
  const auto index_file = folder / membrane_state_index;
  const bool in_pieces = std::filesystem::exists(index_file);
  if (in_pieces && !with_pieces) {
    require_step(exchange::read_surface_index(index_file).field_data, state.step, index_file.string());
    state.membrane_pieces = index_file;
    return;
  }
  const auto file = in_pieces ? index_file : folder / membrane_state_file;
  const auto content = exchange::read_surface(file);
  auto saved = saved_capsules(content, 0, file.string());
  require_step(content.field_data, state.step, file.string());
  state.shapes = std::move(saved.shapes);
  state.positions = std::move(saved.positions);
  state.node_velocity = std::move(saved.node_velocity);
  state.node_force = std::move(saved.node_force);
  state.membranes = std::move(saved.membranes);
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

SavedCapsules read_saved_capsules(const std::filesystem::path& index_file,
                                  const exchange::SurfaceIndex& index, std::size_t piece) {
  const auto name = (index_file.parent_path() / index.pieces.at(piece)).string();
  auto content = exchange::read_surface_piece(index_file, index, piece);
  const auto first = take_first_number(content);
  return saved_capsules(content, first, name);
}

SavedState read_state(const std::filesystem::path& folder, bool with_pieces) {
  SavedState state;
  state.folder = folder;
  read_fluid(folder, state);
  state.step = state.fluid.step;
  read_membranes(folder, with_pieces, state);
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
