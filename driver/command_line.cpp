#include "driver/command_line.hpp"

#include <string>

#include "driver/program/commands.hpp"
#include "driver/program/missing_command.hpp"
#include "driver/program/version.hpp"

namespace tanktread::driver {

std::unique_ptr<CLI::App> command_line(int& exit_code) {
  auto app = std::make_unique<CLI::App>(
      "tanktread: capsules with elastic and viscous membranes in flow, by immersed boundary and lattice "
      "Boltzmann",
      "tanktread");
  app->set_version_flag("--version", std::string("tanktread ") + version + " (commit " + commit + ")");
  app->require_subcommand(1);
  for (const auto add :
       {add_run_command, add_plan_command, add_membrane_command, add_implicit_command, add_coupler_command,
        add_fluid_command, add_replay_command, add_mesh_command, add_study_command, add_diff_command}) {
    add(*app, exit_code);
  }
  put_missing_last(*app);
  return app;
}

}  // namespace tanktread::driver
