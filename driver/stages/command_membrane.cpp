#include <memory>
#include <numbers>

#include "driver/program/commands.hpp"
#include "driver/program/number_option.hpp"
#include "driver/program/signals.hpp"
#include "driver/stages/case_options.hpp"
#include "driver/stages/command_drag.hpp"
#include "driver/stages/stages.hpp"

namespace tanktread::driver {
namespace {

struct Arguments {
  CaseOptions the_case;
  MembraneStage stage;
  MotionStage motion;
  std::string motion_name;
  double amplitude_deg = 10;
};

/// Options of a motion that is given. The defaults of the twist are those of the thesis's Sect. 3.4.2.
void add_motion_options(CLI::App& command, Arguments& arguments) {
  auto& motion = arguments.motion;
  motion.shear_time = motion.twist_period = 1.0;
  motion.every = 0.05;
  auto* name = command.add_option(
      "--motion", arguments.motion_name,
      "A motion in place of --in: the .pvd of surfaces, or `twist`; --out is then a directory");
  for (auto* option : {
           add_number(command, "--amplitude-deg", arguments.amplitude_deg, "Of the twist: A0, degrees", {}),
           add_number(command, "--period", motion.twist_period, "Of the twist: T0, shear times", positive()),
           add_number(command, "--every", motion.every, "Of the twist: shear times between files",
                      positive()),
           add_number(command, "--shear-time", motion.shear_time, "Of the twist: its end, shear times",
                      positive()),
       }) {
    option->needs(name)->capture_default_str();
  }
}

void run_motion(Arguments& arguments) {
  auto& motion = arguments.motion;
  if (arguments.motion_name != "twist") motion.series = arguments.motion_name;
  motion.twist_amplitude = arguments.amplitude_deg * std::numbers::pi / 180;
  motion.the_case = arguments.the_case.read({.fluid_program = false});
  motion.out = arguments.stage.out;
  run_stage(motion);
}

}  // namespace

void add_membrane_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("membrane", "The membranes by themselves, from file to file (docs/components.md)");
  auto arguments = std::make_shared<Arguments>();
  auto& stage = arguments->stage;
  arguments->the_case.add_to(*command);
  auto* in = command->add_option(
      "--in", stage.in, "Surface file with the positions (default: the case at rest, without a step)");
  auto* move = command
                   ->add_flag("--move", stage.move,
                              "First move the nodes by the array `velocity` of --in, for one time step")
                   ->needs(in);
  auto* state =
      command
          ->add_option("--state", stage.state,
                       "History to go on from (.vtu, .pvtu): --out of this command, membrane.vtu or "
                       "membrane.pvtu of a checkpoint (default: none)")
          ->needs(in);
  command->add_option("--out", stage.out, "Surface file to write (.vtu): forces, strain, stress, new history")
      ->required();
  add_motion_options(*command, *arguments);
  command->get_option("--motion")->excludes(in)->excludes(move)->excludes(state);
  // The subcommand has a case and an output of its own, so these are asked for without it only.
  const auto* drag = add_drag_command(*command, exit_code);
  const std::vector<CLI::Option*> required = {command->get_option("--case"), command->get_option("--out")};
  for (auto* option : required) option->required(false);
  command->callback([=, &exit_code] {
    if (drag->parsed()) return;
    for (const auto* option : required)
      if (option->count() == 0) throw CLI::RequiredError(option->get_name());
    // So that a program in the membrane's place, and its packets, end with the stage.
    const SignalGuard guard;
    if (!arguments->motion_name.empty()) {
      run_motion(*arguments);
    } else {
      arguments->stage.the_case = arguments->the_case.read({.fluid_program = false});
      run_stage(arguments->stage);
    }
    exit_code = SignalGuard::caught() == 0 ? 0 : 128 + SignalGuard::caught();
  });
}

}  // namespace tanktread::driver
