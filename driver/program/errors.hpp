// The ways in which a command ends other than well, each with its exit code.
#pragma once

#include <stdexcept>

namespace tanktread::driver {

/// Bad input: the message names the file, the key, the value, the allowed range and the fix. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Exit code of a command that compares and finds a difference.
inline constexpr int exit_different = 1;

/// The run went wrong and must stop; the message says what, where and at which step. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tanktread::driver
