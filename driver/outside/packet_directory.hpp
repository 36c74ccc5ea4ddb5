// Where the packets for a program lie.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "driver/program/output_directory.hpp"

namespace tanktread::driver {

/// A directory for the packets of one program, and their names in it.
class PacketDirectory {
 public:
  /// @param place run.command_directory: a folder in it, which is made and kept; "": a fresh directory in
  /// memory
  /// (/dev/shm) or, if there is none, among the temporary files, which goes with this object
  /// @param name of the folder
  /// @throws InputError if it cannot be made, or another process is at work in it
  PacketDirectory(const std::string& place, const std::string& name);
  ~PacketDirectory();
  PacketDirectory(const PacketDirectory&) = delete;
  PacketDirectory& operator=(const PacketDirectory&) = delete;

  /// The file of the next packet, one of two names in turn: who still reads the packet before is not
  /// disturbed, and nothing has to be removed. @param extension ".vtu"
  std::filesystem::path next_file(const std::string& extension);

 private:
  std::filesystem::path path_;
  std::unique_ptr<DirectoryLock> lock_;  ///< of a directory that stays
  int turn_ = 0;
};

}  // namespace tanktread::driver
