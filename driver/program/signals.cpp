#include "driver/program/signals.hpp"

#include <csignal>

namespace tanktread::driver {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int signal) {
  caught_signal = signal;
}

}  // namespace

SignalGuard::SignalGuard() {
  caught_signal = 0;
  interrupt_ = std::signal(SIGINT, catch_signal);
  terminate_ = std::signal(SIGTERM, catch_signal);
  file_size_ = std::signal(SIGXFSZ, SIG_IGN);
}

SignalGuard::~SignalGuard() {
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
  std::signal(SIGXFSZ, file_size_);
}

int SignalGuard::caught() {
  return caught_signal;
}

}  // namespace tanktread::driver
