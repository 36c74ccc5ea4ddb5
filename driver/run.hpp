// A whole run: from a plan, or on from a checkpoint, to the end.
#pragma once

#include <filesystem>
#include <optional>

#include "driver/plan.hpp"

namespace tanktread::driver {

/// What `tanktread run` was told.
struct RunOptions {
  std::filesystem::path output;
  bool force = false;  ///< an output of an earlier run in that directory may be removed
};

/// Makes the output directory and runs the case to its end.
/// @return 0, or 130 / 143 if SIGINT / SIGTERM ended it (after a checkpoint)
/// @throws InputError, RunError (a last good state is then in the checkpoints), exchange::FileError
int run_new(const Plan& plan, const RunOptions& options);

/// Goes on from the last checkpoint of a directory.
/// @param shear_time a new end of the run, in place of that in echo.toml
/// @param threads in place of that in echo.toml
int run_resumed(const std::filesystem::path& directory, std::optional<double> shear_time,
                std::optional<int> threads);

}  // namespace tanktread::driver
