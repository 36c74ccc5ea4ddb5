// Shear times as whole steps: when something is due.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "driver/units/flow_units.hpp"

namespace tanktread::driver {

/// Every `interval` steps, step 0 included; interval 0: never.
struct Schedule {
  std::int64_t interval = 0;

  bool due(std::int64_t step) const { return interval > 0 && step % interval == 0; }
};

/// Shear times to the nearest whole step.
inline std::int64_t steps_of(double shear_times, const FlowParameters& parameters) {
  return std::llround(shear_times * parameters.steps_per_shear_time);
}

/// Every so many shear times, at least one step apart; 0: never.
inline Schedule schedule_of(double shear_times, const FlowParameters& parameters) {
  if (shear_times == 0.0) return {};
  return {std::max<std::int64_t>(1, steps_of(shear_times, parameters))};
}

}  // namespace tanktread::driver
