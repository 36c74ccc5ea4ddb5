// Checkpoints: the whole state of a run in a folder of VTK files, from which it goes on bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "driver/system.hpp"

namespace tanktread::driver {

/// Writes DIR/checkpoints/step_NNNNNNNNNN (under a temporary name, then renamed) and removes all but the last
/// two: fluid.vti (the solver's arrays) and capsule_K.vtu (positions as points, reference positions,
/// history).
/// @throws exchange::FileError
void write_checkpoint(const System& system, const std::filesystem::path& directory);

/// A checkpoint, read back.
struct Checkpoint {
  std::filesystem::path folder;
  std::int64_t step = 0;
  std::vector<membrane::TriangleMesh> references;  ///< the stress-free mesh of each capsule
  std::vector<Eigen::Matrix3Xd> positions;
  std::vector<std::vector<double>> histories;
  fluid::State fluid;
};

/// The folders of all checkpoints in DIR, oldest first.
std::vector<std::filesystem::path> checkpoint_folders(const std::filesystem::path& directory);

/// Reads the last checkpoint of DIR. @throws InputError if there is none, or it is damaged (with the one
/// before it named) damaged
Checkpoint read_last_checkpoint(const std::filesystem::path& directory);

/// Sets a freshly made system to the state of a checkpoint.
void restore(System& system, const Checkpoint& checkpoint);

}  // namespace tanktread::driver
