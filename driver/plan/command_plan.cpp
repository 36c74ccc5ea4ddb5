#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "driver/plan/plan.hpp"
#include "driver/plan/step_advice.hpp"
#include "driver/program/commands.hpp"
#include "driver/program/number_option.hpp"

namespace tanktread::driver {
namespace {

struct PlanArguments {
  std::string case_file;
  std::vector<std::string> assignments;
  double accuracy = 0;
};

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("plan", "Say what follows from a case and what it will cost, and run nothing");
  auto arguments = std::make_shared<PlanArguments>();
  command->add_option("case", arguments->case_file, "Case file (TOML; docs/case-file.md)")->required();
  command->add_option("--set", arguments->assignments, "key=value, as for run")->allow_extra_args(false);
  auto* accuracy =
      add_number(*command, "--accuracy", arguments->accuracy,
                 "Also say how large a step keeps D within this share, e.g. 0.005 (docs/accuracy.md)",
                 between(1e-6, 0.5));
  command->callback([=, &exit_code] {
    const auto plan = make_plan(read_case(arguments->case_file, arguments->assignments));
    fmt::print("{}", plan.echo);
    if (*accuracy) fmt::print("{}", accuracy_line(plan.the_case, plan.parameters, arguments->accuracy));
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
