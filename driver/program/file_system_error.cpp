#include "driver/program/file_system_error.hpp"

#include <fmt/format.h>

#include <system_error>

namespace tanktread::driver {

std::string message_of(const std::filesystem::filesystem_error& error) {
  const auto other = error.path2().empty() ? "" : fmt::format(" (to {})", error.path2().string());
  const char* fix = is_of_device(error)
                        ? "make room there, or write elsewhere"
                        : "give another path, or make that one such as can be read and written";
  return fmt::format("{}{}: {}; {}", error.path1().string(), other, error.code().message(), fix);
}

bool is_of_device(const std::filesystem::filesystem_error& error) {
  return error.code() == std::errc::no_space_on_device || error.code() == std::errc::io_error;
}

}  // namespace tanktread::driver
