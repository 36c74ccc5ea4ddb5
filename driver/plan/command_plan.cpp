#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "driver/plan/plan.hpp"
#include "driver/plan/rank_report.hpp"
#include "driver/plan/step_advice.hpp"
#include "driver/program/commands.hpp"
#include "driver/program/number_option.hpp"

namespace tanktread::driver {
namespace {

struct PlanArguments {
  std::string case_file;
  std::vector<std::string> assignments;
  double accuracy = 0;
  int ranks = 1;
  bool is_untried = false;
};

void print_plan(const PlanArguments& arguments, bool with_accuracy, bool with_ranks) {
  constexpr double no_bytes_held = 0;
  const auto the_case = read_case(arguments.case_file, arguments.assignments);
  std::optional<ranks::Division> division;  // first: a number of ranks that cannot be needs no probe
  if (with_ranks) division = planned_division(the_case, arguments.ranks);
  const auto trial = arguments.is_untried ? Trial::none : with_ranks ? Trial::sample : Trial::whole;
  const auto plan = make_plan(the_case, {}, no_bytes_held, trial);
  fmt::print("{}", plan.echo);
  if (with_accuracy) fmt::print("{}", accuracy_line(plan.the_case, plan.parameters, arguments.accuracy));
  if (with_ranks) fmt::print("\n{}", rank_report(plan, *division));
}

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
  auto* n_ranks = add_number(*command, "--ranks", arguments->ranks,
                             "Also say what a run on so many ranks of MPI would be (docs/many-ranks.md)",
                             between(1, 1e7));
  command
      ->add_flag("--no-trial", arguments->is_untried,
                 "Do not try the first steps here: no speed, no times, and a box may be larger than the "
                 "memory of this machine")
      ->excludes(n_ranks);
  command->callback([=, &exit_code] {
    print_plan(*arguments, accuracy->count() > 0, n_ranks->count() > 0);
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
