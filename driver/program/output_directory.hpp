// The output directory as a place: made, emptied, and kept from being used twice at once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tanktread::driver {

/// Holds an output directory for one process, by a lock on its file `.lock`, which goes with the process
/// however it ends.
class DirectoryLock {
 public:
  /// @throws InputError if another process holds it, or the directory cannot be written
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_;
};

/// Refuses what is no directory, what lies below a file, and a directory that holds anything but what a
/// killed process left half written. @param option that named it, for the message: "--record" @throws
/// InputError
void require_new_directory(const std::string& option, const std::filesystem::path& directory);

/// Refuses a directory that holds anything, unless `force` is set and it is an earlier run. Writes nothing.
/// @throws InputError
void check_output_directory(const std::filesystem::path& directory, bool force);

/// Whether a path is the output directory itself, or one of the places where a run writes in it, or below
/// such a place.
bool is_place_of_run(const std::filesystem::path& directory, const std::filesystem::path& path);

/// The output directory of the run in one of whose places a path lies: the nearest folder above it with an
/// echo.toml and checkpoints. Nothing: it lies in none.
std::optional<std::filesystem::path> run_that_owns(const std::filesystem::path& path);

/// Removes the files of an earlier run, those that tell it is one last. The lock must be held.
void remove_earlier_run(const std::filesystem::path& directory);

/// A name that only a process that was killed leaves: of exchange's AtomicFile, .NAME.PROCESS-NUMBER.tmp, or
/// of a checkpoint, .step_STEP.tmp and .step_STEP.old.tmp. Other hidden files are somebody's.
bool is_temporary(const std::filesystem::path& file);

/// Removes files that a killed process left half written, in the directory, among its checkpoints and its
/// packets. Other hidden files stay.
void remove_temporary_files(const std::filesystem::path& directory);

}  // namespace tanktread::driver
