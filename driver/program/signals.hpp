// SIGINT and SIGTERM as a wish to end the run with a checkpoint; a file that may not grow as an error of
// writing.
#pragma once

namespace tanktread::driver {

/// Takes SIGINT and SIGTERM while it lives, and ignores SIGXFSZ, so that a write beyond the limit of file
/// sizes (ulimit -f) fails as one on a full disk does instead of ending the program. One at a time.
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
  void (*file_size_)(int);
};

}  // namespace tanktread::driver
