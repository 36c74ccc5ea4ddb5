// The fluid of a system in files: one, or pieces of a large box.
#pragma once

#include <filesystem>

#include "driver/case/case.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// Whether the box has more nodes than output.whole_file_nodes, so that the fluid is written in pieces.
bool has_large_box(const Case& the_case);

/// Whether a system writes it so: not where packets pass through the first of several ranks, which would ask
/// the others for every range of layers.
bool writes_pieces(const System& system, const Case& the_case);

/// Writes density, velocity, force and, with a viscosity contrast, marks of the nodes in output.fluid_box.
/// @param file without an ending: .vti, or .pvti with a piece in the folder of that name
/// @throws exchange::FileError
void write_flow(const System& system, const Case& the_case, const std::filesystem::path& file);

/// Writes the state of a solver. @param file without an ending @throws exchange::FileError
void write_fluid_state(const fluid::Fluid& fluid, bool in_pieces, const std::filesystem::path& file);

/// Sets a solver to a state: whole, or in pieces of which each rank reads what it needs.
/// @throws exchange::FileError naming the piece; std::invalid_argument if the state does not fit
void restore_fluid(fluid::Fluid& fluid, const SavedState& state);

}  // namespace tanktread::driver
