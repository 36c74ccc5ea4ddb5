// The two ways in which a command ends badly, each with its exit code.
#pragma once

#include <stdexcept>

namespace tanktread::driver {

/// Bad input: the message names the file, the key, the value, the allowed range and the fix. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run went wrong and must stop; the message says what, where and at which step. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tanktread::driver
