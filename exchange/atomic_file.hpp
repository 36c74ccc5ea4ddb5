// A file that appears whole or not at all, and text that is added so.
#pragma once

#include <filesystem>
#include <string>

namespace tanktread::exchange {

/// Something to be written to a name of its own in the folder of `target`, and renamed onto it when complete.
/// Until then a reader finds the old file or none; without commit() the temporary file is removed and
/// `target` is untouched.
class AtomicFile {
 public:
  /// A link is left, and the file that it stands for written.
  /// @throws FileError if the folder does not exist, or `target` is there and is no file: a folder, a device,
  /// a pipe
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write: hidden, and unlike that of any other AtomicFile of any process on this machine.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Brings the temporary file to the disk, then renames it. @throws FileError
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Adds text to the end of a file that is there, in one write. If the disk is full the file stays as it was.
/// @throws FileError
void append_text(const std::filesystem::path& file, const std::string& text);

}  // namespace tanktread::exchange
