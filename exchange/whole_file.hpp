// A VTK file that is there to its last byte, held open.
#pragma once

#include <filesystem>

namespace tanktread::exchange {

/// A file held open, so that all looks at it (VTK opens a file more than once) see the same numbers, even if
/// another is renamed onto its name meanwhile.
class WholeFile {
 public:
  /// @throws FileError if it is not there, cannot be read, or does not end as VTK's files do
  explicit WholeFile(std::filesystem::path name);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// The name for messages.
  const std::filesystem::path& name() const { return name_; }
  /// The name to open, valid while this lives.
  const std::filesystem::path& content() const { return content_; }

 private:
  std::filesystem::path name_, content_;
  int descriptor_;
};

}  // namespace tanktread::exchange
