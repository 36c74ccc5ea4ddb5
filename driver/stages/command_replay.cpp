#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "driver/program/commands.hpp"
#include "driver/program/errors.hpp"
#include "driver/stages/replay.hpp"

namespace tanktread::driver {
namespace {

std::string place_of(const ReplayedArray& array) {
  const auto& d = array.difference;
  return fmt::format("step {}, packet {}, array {} ({})", array.step, array.packet, d.name, d.kind);
}

std::int64_t count_steps(const std::vector<ReplayedArray>& arrays) {
  std::int64_t first = arrays.front().step, last = first;
  for (const auto& array : arrays) {
    first = std::min(first, array.step);
    last = std::max(last, array.step);
  }
  return last - first + 1;
}

/// Unchanged settings: every bit must be that of the record.
int report_identity(const ReplayOptions& options, const std::vector<ReplayedArray>& arrays) {
  const auto found =
      std::ranges::find_if(arrays, [](const auto& array) { return !array.difference.identical(); });
  if (found == arrays.end()) {
    fmt::print("{}: identical: {} steps, {} arrays\n", options.component, count_steps(arrays), arrays.size());
    return 0;
  }
  const auto& d = found->difference;
  if (!d.problem.empty()) {
    fmt::print("{}: different: {}: {}\n", options.component, place_of(*found), d.problem);
  } else {
    fmt::print("{}: different: {}, index {} (tuple {}, component {}): recorded {:.17g}, now {:.17g}\n",
               options.component, place_of(*found), d.first, d.first / d.components, d.first % d.components,
               d.first_a, d.first_b);
  }
  fmt::print("recorded in {}\n", found->file.string());
  return exit_different;
}

/// How bad a difference is: what cannot be compared, then not a number, then the size.
std::tuple<int, double> rank(const exchange::ArrayDifference& difference) {
  if (!difference.problem.empty()) return {2, 0.0};
  if (std::isnan(difference.max)) return {1, 0.0};
  return {0, difference.max};
}

/// The largest difference of each array over all steps.
void report_sizes(const ReplayOptions& options, const std::vector<ReplayedArray>& arrays) {
  std::map<std::string, const ReplayedArray*> worst;
  std::vector<std::string> order;
  for (const auto& array : arrays) {
    const auto name = array.packet + " " + array.difference.name;
    auto& entry = worst[name];
    if (entry == nullptr) order.push_back(name);
    if (entry == nullptr || rank(array.difference) > rank(entry->difference)) entry = &array;
  }
  fmt::print("{}: {} steps; of each array the step with the largest difference\n", options.component,
             count_steps(arrays));
  for (const auto& name : order) {
    const auto& d = worst[name]->difference;
    if (!d.problem.empty()) {
      fmt::print("  {:<32} {}\n", name, d.problem);
    } else if (d.identical()) {
      fmt::print("  {:<32} identical\n", name);
    } else {
      fmt::print("  {:<32} max {:.4g}, rms {:.4g}, at step {}, tuple {}, component {}\n", name, d.max, d.rms,
                 worst[name]->step, d.largest / d.components, d.largest % d.components);
    }
  }
  if (!options.out.empty()) fmt::print("as fields: {}\n", options.out.string());
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "replay",
      "Feed a component what `run --record` recorded, and compare what it gives (docs/components.md)");
  auto options = std::make_shared<ReplayOptions>();
  command->add_option("record", options->record, "Directory of tanktread run --record")->required();
  command->add_option("--only", options->component, "The component")
      ->required()
      ->check(CLI::IsMember({"membrane", "implicit", "coupler", "fluid"}));
  command
      ->add_option(
          "--set", options->assignments,
          "key=value, as for run: a setting that is changed; the size of the difference is then reported")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "New directory for the differences as fields (.pvd)");
  command->callback([=, &exit_code] {
    const auto arrays = replay(*options);
    exit_code = 0;
    if (options->assignments.empty()) {
      exit_code = report_identity(*options, arrays);
    } else {
      report_sizes(*options, arrays);
    }
  });
}

}  // namespace tanktread::driver
