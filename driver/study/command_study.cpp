#include "driver/study/command_study.hpp"

#include "driver/program/commands.hpp"
#include "driver/program/missing_command.hpp"

namespace tanktread::driver {

void add_study_command(CLI::App& app, int& exit_code) {
  auto* study = app.add_subcommand("study", "Study components by themselves, against what is exact");
  study->require_subcommand(1);
  add_maxwell_study(*study, exit_code);
  add_noise_study(*study, exit_code);
  add_kernel_study(*study, exit_code);
  add_layers_study(*study, exit_code);
  add_twist_study(*study, exit_code);
  put_missing_last(*study);
  mark_if_all_missing(*study, "the membrane or the coupler");
}

}  // namespace tanktread::driver
