// The whole state of a case between two steps, as a folder of two files.
#pragma once

#include <filesystem>
#include <vector>

#include "driver/stages/packets.hpp"
#include "driver/system.hpp"

namespace tanktread::driver {

/// The files in such a folder: the solver's arrays (state_file), and all membranes with what they need to go
/// on (membrane_file, add_state).
inline constexpr const char* fluid_state_file = "fluid.vti";
inline constexpr const char* membrane_state_file = "membrane.vtu";

/// Makes the folder and writes the state of a system into it. @throws exchange::FileError
void write_state(const std::filesystem::path& folder, const System& system);

/// A state, read back.
struct SavedState {
  std::filesystem::path folder;
  std::int64_t step = 0;
  std::vector<membrane::TriangleMesh> references;  ///< the stress-free mesh of each capsule
  NodeVectors positions, node_velocity, node_force;
  std::vector<MembraneState> membranes;
  fluid::State fluid;
};

/// @throws exchange::FileError
SavedState read_state(const std::filesystem::path& folder);

/// Sets a freshly made system to a state. @throws InputError if it does not fit the case
void restore(System& system, const SavedState& state);

}  // namespace tanktread::driver
