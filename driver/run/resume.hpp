// What a run goes on from: the checkpoint, held against the case and the output. Nothing here writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "driver/engine/engine.hpp"
#include "driver/run/checkpoint.hpp"
#include "driver/run/output.hpp"

namespace tanktread::driver {

/// What `tanktread run --resume` was told of where to go on.
struct ResumeFrom {
  std::optional<std::int64_t> step;  ///< that of a checkpoint; none: the last
  bool accept_gaps = false;          ///< the output may lack what was written before
  bool with_pieces = true;           ///< of the membranes, as read_state()
};

/// A checkpoint that a run can go on from.
struct ResumeStart {
  std::filesystem::path folder;
  SavedState state;
  ResumePoint point;
};

/// Reads the checkpoint and checks all that speaks against it.
/// @param the_case as the directory's echo.toml has it now, with what the command line changes
/// @param output of the run, which is to go on
/// @throws InputError if the checkpoint is damaged, was made by another case, or the output lacks what was
/// written before it; the message names what helps, a checkpoint that can be used among it
ResumeStart find_start(const std::filesystem::path& directory, const Case& the_case, const Output& output,
                       const ResumeFrom& from);

/// Sets an engine to what find_start() has found. A state in pieces is read only here.
/// @throws InputError as find_start()
void restore_start(Engine& engine, const ResumeStart& start, const std::filesystem::path& directory,
                   const Case& the_case, const Output& output);

}  // namespace tanktread::driver
