// A whole run: from a plan, or on from a checkpoint, to the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "driver/plan/plan.hpp"
#include "driver/run/resume.hpp"
#include "driver/run/run_packets.hpp"

namespace tanktread::driver {

/// What `tanktread run` was told.
struct RunOptions {
  std::filesystem::path output;
  bool force = false;  ///< an output of an earlier run in that directory may be removed
  PacketOptions packets;
};

/// Makes the output directory and runs the case to its end.
/// @return 0, or 130 / 143 if SIGINT / SIGTERM ended it (after a checkpoint)
/// @throws InputError, RunError (a last good state is then in the checkpoints), exchange::FileError
int run_new(const Plan& plan, const RunOptions& options);

/// What `tanktread run --resume` was told.
struct ResumeOptions {
  std::filesystem::path directory;
  std::optional<double> shear_time;  ///< a new end of the run, in place of that in echo.toml
  std::optional<int> threads;        ///< in place of those in echo.toml
  ResumeFrom from;
  PacketOptions packets;
};

/// Goes on from a checkpoint of a directory. All that can be refused is, before anything is written.
/// @return as run_new
/// @throws as run_new; InputError too for what find_start refuses
int run_resumed(const ResumeOptions& options);

}  // namespace tanktread::driver
