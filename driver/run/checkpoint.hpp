// Checkpoints: the whole state of a run in a folder of VTK files, from which it goes on bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "driver/system/state_folder.hpp"

namespace tanktread::driver {

/// Writes DIR/checkpoints/step_NNNNNNNNNN (under a temporary name, then renamed) and removes all but the last
/// two. Each is a state folder (write_state).
/// @throws exchange::FileError
void write_checkpoint(const System& system, const std::filesystem::path& directory);

/// Removes all checkpoints of DIR but the last two: more are there if a process was killed before it had
/// removed the oldest, which may be there in part.
void remove_old_checkpoints(const std::filesystem::path& directory);

/// The folders of all checkpoints in DIR, oldest first.
std::vector<std::filesystem::path> checkpoint_folders(const std::filesystem::path& directory);

/// Reads the last checkpoint of DIR. @throws InputError if there is none, or it is damaged (with the one
/// before it named)
SavedState read_last_checkpoint(const std::filesystem::path& directory);

}  // namespace tanktread::driver
