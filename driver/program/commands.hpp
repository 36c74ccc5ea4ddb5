// The subcommands of `tanktread`, one function each: it declares the command and what it does when chosen.
#pragma once

// CLI11's header takes seconds to compile: who does more than pass an App on includes it.
namespace CLI {
class App;
}

namespace tanktread::driver {

/// Each adds its command to `app`; its callback stores the exit code in `exit_code`. Where the program lacks
/// a component that the command needs, the function of that name is the one in driver/absent/.
void add_run_command(CLI::App& app, int& exit_code);
void add_plan_command(CLI::App& app, int& exit_code);
void add_membrane_command(CLI::App& app, int& exit_code);
void add_implicit_command(CLI::App& app, int& exit_code);
void add_coupler_command(CLI::App& app, int& exit_code);
void add_fluid_command(CLI::App& app, int& exit_code);
void add_replay_command(CLI::App& app, int& exit_code);
void add_mesh_command(CLI::App& app, int& exit_code);
void add_study_command(CLI::App& app, int& exit_code);
void add_diff_command(CLI::App& app, int& exit_code);

/// The studies below the command `study`, likewise.
void add_maxwell_study(CLI::App& study, int& exit_code);
void add_noise_study(CLI::App& study, int& exit_code);
void add_kernel_study(CLI::App& study, int& exit_code);
void add_layers_study(CLI::App& study, int& exit_code);
void add_twist_study(CLI::App& study, int& exit_code);

}  // namespace tanktread::driver
