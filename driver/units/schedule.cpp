#include "driver/units/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/program/errors.hpp"

namespace tanktread::driver {

std::int64_t steps_of(double shear_times, const FlowParameters& parameters, const std::string& what) {
  const double steps = shear_times * parameters.steps_per_shear_time;
  // As a double first: what no integer holds must not become one. NaN is refused too.
  if (std::abs(steps) <= static_cast<double>(most_steps)) return std::llround(steps);
  throw InputError(
      fmt::format("{} = {:g} shear times is {:.4g} time steps, over the {} that a run can have; make it at "
                  "most {:.6g}, or a shear time shorter by a faster flow",
                  what, shear_times, steps, most_steps,
                  static_cast<double>(most_steps) / parameters.steps_per_shear_time));
}

std::int64_t last_step_of(const Case& the_case, const FlowParameters& parameters) {
  return steps_of(the_case.run.shear_time, parameters, the_case.file.string() + ": run.shear_time");
}

Schedule schedule_of(double shear_times, const FlowParameters& parameters) {
  if (shear_times == 0.0) return {};
  const double steps = shear_times * parameters.steps_per_shear_time;
  if (!(steps <= static_cast<double>(most_steps))) return {most_steps + 1};
  return {std::max<std::int64_t>(1, std::llround(steps))};
}

std::int64_t times_due(const Schedule& schedule, std::int64_t last_step) {
  if (schedule.interval == 0) return 0;
  return 1 + last_step / schedule.interval + (last_step % schedule.interval == 0 ? 0 : 1);
}

}  // namespace tanktread::driver
