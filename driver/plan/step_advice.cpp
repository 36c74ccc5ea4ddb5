#include "driver/plan/step_advice.hpp"

#include <fmt/format.h>

#include <cmath>

#include "driver/plan/step_error.hpp"

namespace tanktread::driver {
namespace {

/// To three digits, and no more than it is.
double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return unit * std::floor(value / unit);
}

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

/// The largest step that keeps an accuracy.
struct Longest {
  double wall_speed, reynolds_number;  ///< to three digits
  std::string
      in_steps;  ///< "1.5 times fewer steps", "2.3 times as many steps", "2 times fewer, most measured"
};

Longest longest_of(const Case& the_case, const Parameters& p, double accuracy) {
  const auto numbers = step_numbers(the_case, p);
  const double exact = longest_step(numbers, accuracy);
  Longest longest;
  longest.wall_speed = rounded_down(exact * p.wall_speed);
  longest.reynolds_number = rounded_down(exact * p.reynolds_number);
  longest.in_steps = exact < 1 ? fmt::format("{:.3g} times as many steps", 1 / exact)
                     : exact < longest_measured_step(numbers)
                         ? fmt::format("{:.3g} times fewer steps", exact)
                         : fmt::format("{:.3g} times fewer, most measured", exact);
  return longest;
}

}  // namespace

void put_step(EchoTable& table, const Subject& subject) {
  const auto& [the_case, p, si] = subject;
  if (!not_measured(the_case, p).empty()) return;
  constexpr double accuracy = 0.005;
  const auto error = step_error(step_numbers(the_case, p)).largest();
  const auto longest = longest_of(the_case, p, accuracy);
  table.row("error of D by the step", percent(error.deformation), "",
            fmt::format("inclination {:.2g} deg; docs/accuracy.md", error.inclination_deg));
  table.row("U0 for " + percent(accuracy), number(longest.wall_speed), "", longest.in_steps);
}

std::string accuracy_line(const Case& the_case, const Parameters& p, double accuracy) {
  const auto problem = not_measured(the_case, p);
  if (!problem.empty())
    return fmt::format("accuracy {:g}: the step's error is not known here: {}\n", accuracy, problem);
  const auto longest = longest_of(the_case, p, accuracy);
  const auto& [key, value] = the_case.flow.wall_speed
                                 ? std::pair("flow.wall_speed", longest.wall_speed)
                                 : std::pair("flow.reynolds_number", longest.reynolds_number);
  return fmt::format("accuracy {:g}: D within {} by the step at tau+ = {:g} with --set {}={:.4g} ({})\n",
                     accuracy, percent(accuracy), p.relaxation_time, key, value, longest.in_steps);
}

}  // namespace tanktread::driver
