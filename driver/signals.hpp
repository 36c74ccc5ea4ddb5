// SIGINT and SIGTERM as a wish to end the run with a checkpoint.
#pragma once

namespace tanktread::driver {

/// Takes SIGINT and SIGTERM while it lives. One at a time.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  /// The signal that came, or 0.
  static int caught();

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

}  // namespace tanktread::driver
