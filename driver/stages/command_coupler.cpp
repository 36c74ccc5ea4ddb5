#include <memory>

#include "driver/program/commands.hpp"
#include "driver/stages/case_options.hpp"
#include "driver/stages/stages.hpp"

namespace tanktread::driver {
namespace {

template <class Stage>
struct Arguments {
  CaseOptions the_case;
  Stage stage;
};

template <class Stage>
void run_when_called(CLI::App& command, const std::shared_ptr<Arguments<Stage>>& arguments, int& exit_code) {
  command.callback([=, &exit_code] {
    arguments->stage.the_case = arguments->the_case.read({false, false, false});  // none
    run_stage(arguments->stage);
    exit_code = 0;
  });
}

void add_spread_command(CLI::App& coupler, int& exit_code) {
  auto* command = coupler.add_subcommand("spread", "Nodal forces to the grid");
  auto arguments = std::make_shared<Arguments<SpreadStage>>();
  arguments->the_case.add_to(*command);
  command->add_option("--in", arguments->stage.in, "Surface file with the array `total_force`")->required();
  command->add_option("--out", arguments->stage.out, "Grid file to write (.vti), with the array `force`")
      ->required();
  run_when_called(*command, arguments, exit_code);
}

void add_mark_command(CLI::App& coupler, int& exit_code) {
  auto* command = coupler.add_subcommand("mark", "Which nodes of the grid are inside which capsule");
  auto arguments = std::make_shared<Arguments<MarkStage>>();
  arguments->the_case.add_to(*command);
  command->add_option("--in", arguments->stage.in, "Surface file with the nodes")->required();
  command
      ->add_option("--out", arguments->stage.out,
                   "Grid file to write (.vti), with the array `inside`: 0, or the capsule's number from 1")
      ->required();
  run_when_called(*command, arguments, exit_code);
}

void add_interpolate_command(CLI::App& coupler, int& exit_code) {
  auto* command = coupler.add_subcommand("interpolate", "Grid velocities to the nodes");
  auto arguments = std::make_shared<Arguments<InterpolateStage>>();
  arguments->the_case.add_to(*command);
  command
      ->add_option("--in", arguments->stage.in,
                   "Surface file with the nodes (and `total_force`, with coupler.tangential_correction)")
      ->required();
  command->add_option("--grid", arguments->stage.grid, "Grid file with the array `velocity`")->required();
  command
      ->add_option("--out", arguments->stage.out, "Surface file to write (.vtu), with the array `velocity`")
      ->required();
  run_when_called(*command, arguments, exit_code);
}

}  // namespace

void add_coupler_command(CLI::App& app, int& exit_code) {
  auto* coupler = app.add_subcommand(
      "coupler", "The immersed boundary by itself, from files to file (docs/components.md)");
  coupler->require_subcommand(1);
  add_spread_command(*coupler, exit_code);
  add_interpolate_command(*coupler, exit_code);
  add_mark_command(*coupler, exit_code);
}

}  // namespace tanktread::driver
