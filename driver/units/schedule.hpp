// Shear times as whole steps: when something is due.
#pragma once

#include <cstdint>
#include <string>

#include "driver/units/flow_units.hpp"

namespace tanktread::driver {

/// A run ends at this step at the latest: files and checkpoints are named by ten digits, by which they also
/// sort.
inline constexpr std::int64_t most_steps = 9'999'999'999;

/// Every `interval` steps, step 0 included; interval 0: never. An interval beyond the end of a run is due at
/// step 0 only.
struct Schedule {
  std::int64_t interval = 0;

  bool due(std::int64_t step) const { return interval > 0 && step % interval == 0; }
};

/// Shear times to the nearest whole step.
/// @param what of the message: "case.toml: run.shear_time" @throws InputError beyond most_steps
std::int64_t steps_of(double shear_times, const FlowParameters& parameters, const std::string& what);

/// The last step of the run, by run.shear_time. @throws InputError beyond most_steps
std::int64_t last_step_of(const Case& the_case, const FlowParameters& parameters);

/// Every so many shear times, at least one step apart, and beyond the end of any run if that is more than
/// most_steps; 0: never.
Schedule schedule_of(double shear_times, const FlowParameters& parameters);

/// How often something is written in a run: at step 0, at each step that is due, and at the last; 0: never.
std::int64_t times_due(const Schedule& schedule, std::int64_t last_step);

}  // namespace tanktread::driver
