// The whole state of a case between two steps, read from a folder of three files, or these in pieces. It
// takes no component to read one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/packets/membrane_state.hpp"
#include "driver/packets/packets.hpp"
#include "exchange/packet.hpp"
#include "exchange/surface_pieces.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::driver {

/// The files in such a folder: the solver's arrays (state_file, fluid_files.hpp), and all membranes with what
/// they need to go on (membrane_file, add_state, membrane_files.hpp), and the case that made it (to_toml).
inline constexpr const char* fluid_state_file = "fluid.vti";
/// In its place where the fluid's state is in pieces: their index.
inline constexpr const char* fluid_state_index = "fluid.pvti";
inline constexpr const char* membrane_state_file = "membrane.vtu";
/// In its place where the membranes are in pieces: their index.
inline constexpr const char* membrane_state_index = "membrane.pvtu";
inline constexpr const char* case_state_file = "echo.toml";

/// Point data of the membranes in a state: the nodes of the stress-free shapes, and those at the start of the
/// case, which a file lacks where they are the same.
inline constexpr const char* reference_array = "reference_position";
inline constexpr const char* start_array = "start_position";

/// A state, read back.
struct SavedState {
  std::filesystem::path folder;
  std::int64_t step = 0;
  std::optional<Case> the_case;  ///< that made it; none: an earlier version, which did not write it
  MembraneShapes shapes;         ///< that its membranes were made from
  NodeVectors positions, node_velocity, node_force;
  std::vector<MembraneState> membranes;
  fluid::State fluid;                     ///< without arrays if it is in pieces, which are large
  std::filesystem::path fluid_pieces;     ///< their index; "": `fluid` has all
  std::filesystem::path membrane_pieces;  ///< their index if they are left to be read; "": all is above
};

/// Some capsules of a state, which follow one another.
struct SavedCapsules {
  std::size_t first = 0;  ///< its number in the case
  MembraneShapes shapes;
  NodeVectors positions, node_velocity, node_force;
  std::vector<MembraneState> membranes;
};

/// The capsules in one piece of the membranes of a state. @param piece of the index
/// @throws exchange::FileError
SavedCapsules read_saved_capsules(const std::filesystem::path& index_file,
                                  const exchange::SurfaceIndex& index, std::size_t piece);

/// What the case names outside (meshes, programs) need not be there.
/// @param with_pieces membranes in pieces are read too, else they are left, for each rank to read some
/// @throws exchange::FileError
SavedState read_state(const std::filesystem::path& folder, bool with_pieces = true);
/// The case alone that made the state in a folder; none: it holds no case. @throws exchange::FileError
std::optional<Case> read_state_case(const std::filesystem::path& folder);

/// The state of a solver from its file (state_file). @param name of the file, for messages
/// @throws exchange::FileError for a later schema version
fluid::State state_of(exchange::GridPacket file, const std::string& name);

/// The shapes that the membranes in a file of a state were made from. @param surfaces of the file
/// @param name of the file, for messages @throws exchange::FileError if they are missing
MembraneShapes shapes_of(const exchange::SurfacePacket& file, const Surfaces& surfaces,
                         const std::string& name);

/// The array of field data that holds the history of a capsule: history_0, history_1 ...
std::string history_name(std::size_t capsule);
/// What the names of a program's arrays begin with, in the field data of a state: program_0_point_ ...
/// @param kind "point" | "cell"
std::string program_prefix(std::size_t capsule, const char* kind);
/// The state of one capsule's membrane. @throws exchange::FileError if its history is missing
MembraneState membrane_state_of(const exchange::SurfacePacket& file, std::size_t capsule,
                                const std::string& name);

}  // namespace tanktread::driver
