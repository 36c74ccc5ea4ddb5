#include <memory>

#include "driver/program/commands.hpp"
#include "driver/program/number_option.hpp"
#include "driver/stages/case_options.hpp"
#include "driver/stages/stages.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {

void add_fluid_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    CaseOptions the_case;
    FluidStage stage;
  };
  auto* command =
      app.add_subcommand("fluid", "The flow solver by itself, from file to file (docs/components.md)");
  auto arguments = std::make_shared<Arguments>();
  auto& stage = arguments->stage;
  arguments->the_case.add_to(*command);
  command->add_option("--state", stage.state,
                      "State to go on from (.vti): --out of this command, fluid.vti of a checkpoint "
                      "(default: the start of the case)");
  command->add_option("--force", stage.force,
                      "Grid file with the array `force`, held through all steps (default: none)");
  command->add_option("--inside", stage.inside,
                      "Grid file with the array `inside`: --out of tanktread coupler mark (default: "
                      "viscosities stay as they are)");
  add_number(*command, "--steps", stage.n_steps, "Time steps to take", between(0, most_steps))
      ->capture_default_str();
  command->add_option("--out", stage.out, "State to write (.vti)")->required();
  command->add_option(
      "--fields", stage.fields,
      "Grid file to write too: density, velocity, force; and inside, if --inside has it of all nodes");
  command->add_option("--free", stage.free,
                      "Grid file to write too: velocity of the next step without forces, and mobility");
  command->callback([=, &exit_code] {
    arguments->stage.the_case = arguments->the_case.read({.meshes = false, .membrane_programs = false});
    run_stage(arguments->stage);
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
