// The live line of a run: time, D, inclination, speed, what remains.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "driver/observe/observables.hpp"

namespace tanktread::driver {

/// Prints one line that rewrites itself on a terminal (twice a second), or a line every ten seconds into a
/// file.
class Progress {
 public:
  Progress(std::int64_t first_step, std::int64_t last_step, std::int64_t n_nodes, double shear_rate);

  /// Takes note of the newest measurements, for the lines to come.
  void observe(const std::vector<Observation>& observations);
  /// Prints a line if it is time. @param step the step just done
  void update(std::int64_t step);
  /// Prints the last line, whatever the time.
  void finish(std::int64_t step);
  /// Since the start.
  double seconds() const;
  /// Million lattice node updates a second since the start.
  double mlups(std::int64_t step) const;

 private:
  void print(std::int64_t step);

  std::int64_t first_step_, last_step_, n_nodes_;
  double shear_rate_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, last_print_;
  std::string measured_;
};

}  // namespace tanktread::driver
