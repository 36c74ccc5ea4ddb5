// The file that a command is told to write: looked at before any work, so that nothing of a user's is
// replaced.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tanktread::driver {

/// A file that an option names.
struct NamedFile {
  std::string option;  ///< "--out", for messages
  std::filesystem::path file;
};

/// What a command writes.
struct OutputKind {
  std::string extension;    ///< of its name
  std::string what;         ///< "a surface file of tanktread", for messages
  std::string begins_with;  ///< how a file begins that it may replace
  std::string has;          ///< and what stands in the head of such a file, somewhere
};
/// Files of exchange/, known by their VTK type and by the hash that they alone have.
OutputKind surface_output();
OutputKind grid_output();
/// A table. @param header its first line with the line end; only a table with the same may be replaced
OutputKind table_output(const std::string& header);

/// Refuses an output that cannot be written, and one over something of another kind. An empty file has
/// nothing to lose. Writes nothing.
/// @param inputs the files that the same command reads; those without a name are left out
/// @throws InputError for another extension, a folder that is not there, a folder, a file of another kind,
/// a file that the command reads, and a place of a run (run_that_owns); with option, file and fix
void check_output(const NamedFile& output, const OutputKind& kind, const std::vector<NamedFile>& inputs = {});

}  // namespace tanktread::driver
