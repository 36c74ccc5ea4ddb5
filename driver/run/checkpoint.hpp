// Checkpoints: the whole state of a run in a folder of files, from which it goes on bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "driver/run/row_counts.hpp"
#include "driver/system/state_folder.hpp"

namespace tanktread::driver {

/// Writes DIR/checkpoints/step_NNNNNNNNNN (under a temporary name, then renamed; in the place of one of that
/// step, which may be damaged or of another case) and removes all but the last two, and of those set aside
/// the ones that it replaces: of its step and before. Each is a state folder (write_state) with the counts
/// of rows.
/// @param write_state_to writes the state to a folder
/// @param counts of the rows of the tables so far
/// @throws exchange::FileError
void write_checkpoint(std::int64_t step,
                      const std::function<void(const std::filesystem::path&)>& write_state_to,
                      const RowCounts& counts, const std::filesystem::path& directory);

/// Removes all checkpoints of DIR but the last two: more are there if a process was killed before it had
/// removed the oldest, which may be there in part.
void remove_old_checkpoints(const std::filesystem::path& directory);

/// The folders of all checkpoints in DIR, oldest first, without those set aside.
std::vector<std::filesystem::path> checkpoint_folders(const std::filesystem::path& directory);

/// The folder to go on from: the last checkpoint, or that of a step, which may be set aside.
/// @throws InputError if there is none; it names those that are there
std::filesystem::path find_checkpoint(const std::filesystem::path& directory,
                                      std::optional<std::int64_t> step);

/// The folders of all checkpoints in DIR but this one, those set aside too, last step first.
std::vector<std::filesystem::path> other_checkpoints(const std::filesystem::path& directory,
                                                     const std::filesystem::path& folder);

/// What a checkpoint holds.
struct Checkpoint {
  SavedState state;
  std::optional<RowCounts> counts;  ///< of rows; none: of an earlier version
};

/// @param with_pieces as read_state() @throws exchange::FileError if it is damaged
Checkpoint read_checkpoint(const std::filesystem::path& folder, bool with_pieces = true);

/// Makes the checkpoint in this folder the last one of DIR: later ones are set aside as
/// checkpoints/set_aside_NNNNNNNNNN, until new ones replace them; one that was set aside comes back.
/// @return where it is now
std::filesystem::path make_last(const std::filesystem::path& directory, const std::filesystem::path& folder);

}  // namespace tanktread::driver
