// When a run writes a checkpoint.
#pragma once

#include <cstdint>

#include "driver/units/schedule.hpp"

namespace tanktread::driver {

/// By shear time, and by the clock of the wall: what a batch system ends without asking has lost no more than
/// that. Which checkpoints were written changes no result.
class CheckpointTimes {
 public:
  /// @param minutes between two, at the most; 0: no matter
  CheckpointTimes(const Schedule& every, std::int64_t last_step, double minutes)
      : every_(every), last_step_(last_step), seconds_between_(60 * minutes) {}

  /// Whether one is due after this step. @param seconds since the start of the run
  bool due(std::int64_t step, double seconds) const {
    const bool by_clock = seconds_between_ > 0 && seconds - last_ >= seconds_between_;
    return by_clock || every_.due(step) || step == last_step_;
  }

  /// One was written: the minutes begin anew, from the end of the writing, which takes time itself.
  void wrote(double seconds) { last_ = seconds; }

 private:
  Schedule every_;
  std::int64_t last_step_;
  double seconds_between_;
  double last_ = 0;
};

}  // namespace tanktread::driver
