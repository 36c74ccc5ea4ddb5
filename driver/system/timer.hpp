// Time that the parts of a step take.
#pragma once

#include <chrono>

namespace tanktread::driver {

/// Adds the time between its making and its end to an account.
class Timer {
 public:
  explicit Timer(double& seconds) : seconds_(seconds) {}
  ~Timer() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Calls a phase, or a part of one, and adds the time that it takes to its account.
template <class Phase>
auto timed(double& seconds, const Phase& phase) {
  const Timer timer(seconds);
  return phase();
}

}  // namespace tanktread::driver
