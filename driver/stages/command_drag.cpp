#include "driver/stages/command_drag.hpp"

#include <memory>

#include "driver/program/number_option.hpp"
#include "driver/program/signals.hpp"
#include "driver/stages/case_options.hpp"
#include "driver/stages/stages.hpp"

namespace tanktread::driver {

CLI::App* add_drag_command(CLI::App& membrane, int& exit_code) {
  struct Arguments {
    CaseOptions the_case;
    DragStage stage;
  };
  auto* command = membrane.add_subcommand(
      "drag", "The membranes under their own forces and loads, against a drag, no fluid (docs/loads.md)");
  auto arguments = std::make_shared<Arguments>();
  auto& stage = arguments->stage;
  arguments->the_case.add_to(*command);
  command->add_option("--in", stage.in, "Surface file to start from (default: the start of the case)");
  command
      ->add_option(
          "--out", stage.out,
          "Directory to write: drag.csv, membrane.pvd, by output.observables_every and membrane_every")
      ->required();
  add_number(*command, "--drag", stage.drag, "zeta a/mu_o, zeta the drag per area and velocity", positive())
      ->capture_default_str();
  add_number(*command, "--step", stage.step,
             "Shear times (default: by the highest rate of the membrane, found by trial)", positive());
  add_number(*command, "--shear-time", stage.shear_time, "The end (default: run.shear_time)", positive());
  add_number(*command, "--still", stage.still,
             "Stop where no node is faster, radii per shear time, and no load is yet to be switched off",
             positive());
  command->callback([=, &exit_code] {
    const SignalGuard guard;
    arguments->stage.the_case = arguments->the_case.read({.fluid_program = false});
    run_stage(arguments->stage);
    exit_code = SignalGuard::caught() == 0 ? 0 : 128 + SignalGuard::caught();
  });
  return command;
}

}  // namespace tanktread::driver
