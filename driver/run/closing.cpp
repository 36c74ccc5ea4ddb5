#include "driver/run/closing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "driver/program/signals.hpp"
#include "driver/run/memory_speed.hpp"
#include "driver/system/components.hpp"
#include "driver/system/run_ranks.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {
namespace {

/// The speed of memory over an array as large as the lattice, or large enough for any cache.
double memory_speed(const Case& the_case) {
  constexpr std::int64_t bytes_of_number = 8, most_numbers = std::int64_t{1} << 25;
  constexpr int most_passes = 12;
  constexpr double most_seconds = 0.3;
  std::int64_t lattice_bytes = fluid::lattice_boltzmann_memory_per_node(storage_of(the_case.flow));
  for (const int n : the_case.flow.box) lattice_bytes *= n;
  if (other_ranks() != nullptr) lattice_bytes /= other_ranks()->size();  // no more than its part
  const auto n = std::min(lattice_bytes / bytes_of_number, most_numbers);
  return update_in_place_speed(n, most_passes, most_seconds, the_case.run.threads);
}

}  // namespace

std::string time_table(const StepSeconds& steps, double files, double whole) {
  constexpr std::string_view implicit = "implicit forces", inside = "inside", messages = "other ranks";
  std::pair<std::string_view, double> rows[] = {{"fluid", steps.fluid},
                                                {"forced nodes", steps.forced_nodes},
                                                {"stencils", steps.stencils},
                                                {"interpolation", steps.interpolation},
                                                {"spreading", steps.spreading},
                                                {"correction", steps.correction},
                                                {"membranes", steps.membranes},
                                                {inside, steps.inside},
                                                {implicit, steps.implicit},
                                                {messages, steps.messages},
                                                {"files", files},
                                                {"else", whole}};
  auto& rest = std::end(rows)[-1].second;
  for (const auto& [name, seconds] : rows) {
    if (&seconds != &rest) rest -= seconds;
  }
  std::string text = fmt::format("{:<16}{:>12}{:>9}\n", "time of", "seconds", "%");
  for (const auto& [name, seconds] : rows) {
    if (seconds == 0 && (name == implicit || name == inside || name == messages))
      continue;  // few runs have them
    text += fmt::format("  {:<15}{:>11.3f}{:>9.1f}\n", name, seconds, 100 * seconds / whole);
  }
  return text;
}

std::string bound_line(double bytes_a_second, double of_memory) {
  if (of_memory <= 0) return "";
  return fmt::format(
      "the fluid moves {:.1f} GB/s at the least, {:.0f} % of the {:.1f} GB/s at which memory is updated in "
      "place here\n",
      1e-9 * bytes_a_second, 100 * bytes_a_second / of_memory, 1e-9 * of_memory);
}

void print_closing(std::int64_t step, const StepSeconds& seconds, const Case& the_case,
                   const Progress& progress, double files, const std::filesystem::path& directory) {
  constexpr double shortest_run = 3;  // seconds; the measurement is to be a small part of it
  const double whole = progress.seconds(), mlups = progress.mlups(step);
  if (seconds.fluid > 0) fmt::print("{}", time_table(seconds, files, whole));
  if (whole > shortest_run && SignalGuard::caught() == 0 && the_case.flow.command.empty()) {
    const double bytes =
        1e6 * mlups * whole * fluid::lattice_boltzmann_bytes_per_node(storage_of(the_case.flow));
    fmt::print("{}", bound_line(bytes / seconds.fluid, memory_speed(the_case)));
  }
  fmt::print("ended at step {} with {:.1f} MLUPS; results are in {}\n", step, mlups, directory.string());
}

}  // namespace tanktread::driver
