// What the standard library says of a path that the system refuses, in words for users.
#pragma once

#include <filesystem>
#include <string>

namespace tanktread::driver {

/// "DIR/x: Permission denied; give another path, or make that one such as can be read and written": the path
/// and the system's reason. error.what() would name a function of the standard library before them.
std::string message_of(const std::filesystem::filesystem_error& error);

/// Whether the device failed (full, broken), and not the path that a user gave.
bool is_of_device(const std::filesystem::filesystem_error& error);

}  // namespace tanktread::driver
