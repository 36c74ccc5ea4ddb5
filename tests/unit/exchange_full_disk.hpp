// A disk that is full, for tests.
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstddef>

namespace tanktread::exchange::testing {

/// No file can grow beyond `n_bytes` while this lives: a write that would fails, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(std::size_t n_bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{n_bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

}  // namespace tanktread::exchange::testing
