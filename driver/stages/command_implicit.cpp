#include <memory>

#include "driver/program/commands.hpp"
#include "driver/stages/case_options.hpp"
#include "driver/stages/stages.hpp"

namespace tanktread::driver {

void add_implicit_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    CaseOptions the_case;
    ImplicitStage stage;
  };
  auto* command = app.add_subcommand(
      "implicit", "The implicit viscous forces by themselves, from files to file (docs/components.md)");
  auto arguments = std::make_shared<Arguments>();
  arguments->the_case.add_to(*command);
  command
      ->add_option("--in", arguments->stage.in,
                   "Surface file: --out of tanktread membrane, whose `total_force` is without these forces")
      ->required();
  command
      ->add_option("--grid", arguments->stage.grid,
                   "Grid file with the arrays `velocity` and `mobility`: --free of tanktread fluid")
      ->required();
  command
      ->add_option("--out", arguments->stage.out,
                   "Surface file to write (.vtu): --in with all forces, and the new history")
      ->required();
  command->callback([=, &exit_code] {
    arguments->stage.the_case =
        arguments->the_case.read({.fluid_program = false, .membrane_programs = false});
    run_stage(arguments->stage);
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
