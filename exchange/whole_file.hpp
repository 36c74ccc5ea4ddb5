// A VTK file that is there to its last byte, held open.
#pragma once

#include <filesystem>
#include <string>

#include "exchange/descriptor.hpp"

namespace tanktread::exchange {

/// A file held open, so that all looks at it (VTK opens a file more than once) see the same numbers, even if
/// another is renamed onto its name meanwhile.
class WholeFile {
 public:
  /// @param type VTK's type of what it should be, for the message: "UnstructuredGrid"
  /// @throws FileError if it is not there, cannot be read, is of another format, or does not end as VTK's
  /// files do
  WholeFile(std::filesystem::path name, const std::string& type);

  /// The name for messages.
  const std::filesystem::path& name() const { return name_; }
  /// The name to open, valid while this lives.
  const std::filesystem::path& content() const { return content_; }

 private:
  std::filesystem::path name_, content_;
  Descriptor open_;
};

/// All of a VTK file to which another process may be adding (FileTail): never a half of what it adds, for
/// which this waits.
/// @param type as WholeFile's @throws FileError as WholeFile does
std::string read_growing_text(const std::filesystem::path& file, const std::string& type);

}  // namespace tanktread::exchange
