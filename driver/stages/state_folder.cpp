#include "driver/stages/state_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "driver/stages/fluid_files.hpp"
#include "driver/stages/membrane_files.hpp"
#include "driver/stages/packet_files.hpp"
#include "driver/stages/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

void read_membranes(const std::filesystem::path& file, SavedState& state) {
  const auto content = exchange::read_surface(file);
  const auto name = file.string();
  auto surfaces = surfaces_of(content, name);
  const auto references = vectors_of(content, "reference_position", surfaces, name);
  for (std::size_t k = 0; k < references.size(); ++k) {
    state.references.push_back({references[k], surfaces.triangles[k]});
    state.membranes.push_back(membrane_state_of(content, k, name));
  }
  state.node_velocity = vectors_of(content, "velocity", surfaces, name);
  state.node_force = vectors_of(content, "total_force", surfaces, name);
  state.positions = std::move(surfaces.positions);
  if (step_of(content.field_data, name) != state.step) {
    throw exchange::FileError(fmt::format("{}: of step {}, the fluid beside it of step {}", name,
                                          step_of(content.field_data, name), state.step));
  }
}

}  // namespace

void write_state(const std::filesystem::path& folder, const System& system) {
  std::filesystem::create_directories(folder);
  exchange::write_grid(folder / fluid_state_file, state_file(system.fluid->state(), system.fluid->shape()));
  auto membranes = membrane_file(system.membranes, system.node_velocity, system.node_force, system.step,
                                 system.shear_time());
  add_state(membranes, system.membranes);
  exchange::write_surface(folder / membrane_state_file, membranes);
}

SavedState read_state(const std::filesystem::path& folder) {
  SavedState state;
  state.folder = folder;
  const auto fluid = folder / fluid_state_file;
  state.fluid = state_of(exchange::read_grid(fluid), fluid.string());
  state.step = state.fluid.step;
  read_membranes(folder / membrane_state_file, state);
  return state;
}

void restore(System& system, const SavedState& state) {
  if (state.positions.size() != system.membranes.size()) {
    throw InputError(fmt::format("{}: {} capsules, the case has {}", state.folder.string(),
                                 state.positions.size(), system.membranes.size()));
  }
  system.step = state.step;
  system.node_velocity = state.node_velocity;
  system.node_force = state.node_force;
  try {
    system.fluid->restore(state.fluid);
    for (std::size_t k = 0; k < system.membranes.size(); ++k) {
      system.membranes[k].set_positions(state.positions[k]);
      system.membranes[k].restore(state.membranes[k]);
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: does not fit the case: {}", state.folder.string(), error.what()));
  }
  build_stencils(*system.coupler, state.positions);
}

}  // namespace tanktread::driver
