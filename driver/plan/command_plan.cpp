#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "driver/plan/plan.hpp"
#include "driver/program/commands.hpp"

namespace tanktread::driver {
namespace {

struct PlanArguments {
  std::string case_file;
  std::vector<std::string> assignments;
};

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("plan", "Say what follows from a case and what it will cost, and run nothing");
  auto arguments = std::make_shared<PlanArguments>();
  command->add_option("case", arguments->case_file, "Case file (TOML; docs/case-file.md)")->required();
  command->add_option("--set", arguments->assignments, "key=value, as for run")->allow_extra_args(false);
  command->callback([=, &exit_code] {
    fmt::print("{}", make_plan(read_case(arguments->case_file, arguments->assignments)).echo);
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
