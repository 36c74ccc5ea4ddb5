// A run that went wrong.
#pragma once

#include <stdexcept>

namespace tanktread::driver {

/// The run went wrong and must stop; the message says what, where and at which step. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tanktread::driver
