#include <memory>

#include "driver/case/names.hpp"
#include "driver/study/command_study.hpp"
#include "driver/study/study_noise.hpp"

namespace tanktread::driver {

void add_noise_study(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand(
      "strain-rate-noise",
      "The strain rate from interpolated velocities along a streamline of a corner flow");
  auto noise = std::make_shared<NoiseStudy>();
  auto intervals = std::make_shared<std::vector<int>>(std::vector{1, 5, 10, 20, 40});
  auto file = std::make_shared<std::string>();
  command->add_option("--kernel", noise->kernel, names_text("Discrete delta", kernel_names()))
      ->capture_default_str();
  add_number(*command, "--nodes", noise->nodes, "Grid steps along a side of the unit square",
             between(1, NoiseStudy::most_nodes))
      ->capture_default_str();
  add_number(*command, "--dt", noise->time_step, "Time step, times of the flow 3 x^2 y - y^3", positive())
      ->capture_default_str();
  add_number(*command, "--positions", noise->n_positions, "Positions along the streamline",
             between(2, NoiseStudy::most_positions))
      ->capture_default_str();
  add_number(*command, "--psi", noise->stream_function, "Stream function of the streamline", positive())
      ->capture_default_str();
  add_number(*command, "--start", noise->start_height, "y of the first position, sides of the square",
             positive())
      ->capture_default_str();
  add_number(*command, "--velocity-error", noise->velocity_error,
             "Relative error that all grid velocities are given", {})
      ->capture_default_str();
  add_number(*command, "--interval", *intervals, "Intervals N of the backward difference, steps",
             between(1, NoiseStudy::most_positions - 1))
      ->capture_default_str();
  add_file_option(*command, *file);
  command->callback([=, &exit_code] {
    write_table(*file, noise_table(*noise, {}), [&] { return noise_table(*noise, *intervals); });
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
