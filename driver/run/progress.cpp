#include "driver/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "driver/plan/duration.hpp"

namespace tanktread::driver {

Progress::Progress(std::int64_t first_step, std::int64_t last_step, std::int64_t n_nodes, double shear_rate)
    : first_step_(first_step),
      last_step_(last_step),
      n_nodes_(n_nodes),
      shear_rate_(shear_rate),
      terminal_(isatty(STDOUT_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_print_(start_) {}

void Progress::observe(const std::vector<Observation>& observations) {
  if (observations.empty()) return;
  const auto& first = observations.front();
  measured_ = fmt::format("D {:.4f}  inclination {:6.2f} deg", first.deformation, first.inclination_deg);
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Progress::mlups(std::int64_t step) const {
  const double elapsed = seconds();
  return elapsed > 0 ? 1e-6 * static_cast<double>(n_nodes_ * (step - first_step_)) / elapsed : 0.0;
}

void Progress::update(std::int64_t step) {
  const auto interval = terminal_ ? std::chrono::milliseconds(500) : std::chrono::milliseconds(10000);
  if (std::chrono::steady_clock::now() - last_print_ < interval) return;
  print(step);
}

void Progress::finish(std::int64_t step) {
  print(step);
  if (terminal_) std::fputs("\n", stdout);
  std::fflush(stdout);
}

void Progress::print(std::int64_t step) {
  last_print_ = std::chrono::steady_clock::now();
  const double speed = mlups(step);
  const double remaining =
      speed > 0 ? 1e-6 * static_cast<double>(n_nodes_ * (last_step_ - step)) / speed : 0.0;
  fmt::print("{}time {:7.3f} of {:.3f}  {}  {:.1f} MLUPS  {} left{}", terminal_ ? "\r" : "",
             static_cast<double>(step) * shear_rate_, static_cast<double>(last_step_) * shear_rate_,
             measured_, speed, duration_text(remaining), terminal_ ? "   " : "\n");
  std::fflush(stdout);
}

}  // namespace tanktread::driver
