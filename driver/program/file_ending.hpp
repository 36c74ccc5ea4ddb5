// Endings of file names.
#pragma once

#include <filesystem>

namespace tanktread::driver {

/// The file with an ending behind its name, whatever dots that has. @param ending ".vtu"
inline std::filesystem::path with_ending(std::filesystem::path file, const char* ending) {
  return file += ending;
}

}  // namespace tanktread::driver
