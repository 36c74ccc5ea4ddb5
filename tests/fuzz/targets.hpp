// What is fuzzed: each target reads one input that nobody has checked, as the program reads it.
#pragma once

#include <string_view>
#include <vector>

namespace tanktread::fuzz {

struct Target {
  const char* name;
  /// Reads the bytes of a file, or of a word of the command line. Bad input ends quietly; anything but the
  /// errors that the reader promises comes out as it is. @throws std::logic_error if what was read does not
  /// survive being written and read again
  void (*read)(std::string_view bytes);
};

/// All targets: case_file, assignment, surface, grid, surface_index, grid_index, series, table, observables.
const std::vector<Target>& targets();

/// @throws std::out_of_range for a name that none has
const Target& target(std::string_view name);

}  // namespace tanktread::fuzz
