#include "driver/system/state_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "driver/program/errors.hpp"
#include "driver/system/fluid_output.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

void write_state(const std::filesystem::path& folder, const System& system, const Case& the_case,
                 FileSizes sizes) {
  std::filesystem::create_directories(folder);
  const bool in_pieces = sizes == FileSizes::by_case && writes_pieces(system, the_case);
  write_fluid_state(*system.fluid, in_pieces, folder / std::filesystem::path(fluid_state_file).stem());
  write_surfaces(
      {folder / std::filesystem::path(membrane_state_file).stem(), true, most_triangles(the_case, sizes)},
      capsules_now(system));
  exchange::write_text(folder / case_state_file, to_toml(the_case));
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
    restore_fluid(*system.fluid, state);
    for (std::size_t k = 0; k < system.membranes.size(); ++k) {
      system.membranes[k].set_positions(state.positions[k]);
      system.membranes[k].restore(state.membranes[k]);
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: does not fit the case: {}", state.folder.string(), error.what()));
  }
  try {
    const auto triangles = surfaces_of(system.membranes).triangles;
    build_stencils(*system.coupler, system.corrections, state.positions, triangles);
    // The fluid's state has the viscosities already.
    if (system.inside) mark_inside(*system.inside, state.positions, triangles, true);
  } catch (const coupler::StencilError& error) {
    throw InputError(fmt::format("{}: {}", state.folder.string(), error.what()));
  } catch (const coupler::InsideError& error) {
    throw InputError(fmt::format("{}: {}", state.folder.string(), error.what()));
  }
}

}  // namespace tanktread::driver
