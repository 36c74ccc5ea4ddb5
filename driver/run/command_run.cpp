#include <fmt/format.h>

#include <memory>

#include "driver/case/schema.hpp"
#include "driver/program/commands.hpp"
#include "driver/program/number_option.hpp"
#include "driver/program/output_directory.hpp"
#include "driver/run/run.hpp"
#include "driver/system/run_ranks.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {
namespace {

struct RunArguments {
  std::string case_file, output, resume;
  std::vector<std::string> assignments;
  bool force = false;
  double shear_time = 0;
  int threads = 0;
  std::int64_t from_step = 0;
  bool accept_gaps = false;
  PacketOptions packets;
};

/// The folder that holds the case gives the output its name; a file of another name than case.toml gives its
/// own.
std::filesystem::path default_output(const std::filesystem::path& case_file) {
  const auto stem = case_file.stem();
  if (stem != "case") return std::filesystem::path("output") / stem;
  return std::filesystem::path("output") / std::filesystem::absolute(case_file).parent_path().filename();
}

int run_case(const RunArguments& arguments) {
  RunOptions options;
  options.output = arguments.output.empty() ? default_output(arguments.case_file)
                                            : std::filesystem::path(arguments.output);
  options.force = arguments.force;
  options.packets = arguments.packets;
  const auto the_case = read_case(arguments.case_file, arguments.assignments);
  check_output_directory(options.output, options.force);  // before the probe of the speed
  const auto of_ranks = ranks_line(the_case);             // which may refuse the case
  const auto plan = make_plan(the_case);
  fmt::print("{}{}", plan.echo, of_ranks);
  return run_new(plan, options);
}

/// Options of what goes from phase to phase.
void add_packet_options(CLI::App& command, PacketOptions& packets) {
  auto* record = command.add_option("--record", packets.record,
                                    "Write every packet of the steps --from to --to into this directory");
  const auto steps = between(0, most_steps);
  add_number(command, "--from", packets.from, "First time step to record (default: the first)", steps)
      ->needs(record);
  add_number(command, "--to", packets.to, "Last time step to record (default: the end of the run)", steps)
      ->needs(record);
  command
      .add_flag("--through-files", packets.through_files,
                "Hand every packet on by way of a file in OUTPUT/packets")
      ->excludes(record);
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "Run a case, or go on from its last checkpoint");
  auto arguments = std::make_shared<RunArguments>();
  auto* case_file = command->add_option("case", arguments->case_file, "Case file (TOML; docs/case-file.md)");
  auto* output = command->add_option("--output,--out", arguments->output,
                                     "Output directory (default: output/NAME of the case)");
  auto* force =
      command->add_flag("--force", arguments->force, "Remove an earlier run from the output directory");
  auto* threads =
      add_number(*command, "--threads", arguments->threads,
                 "OpenMP threads, 0: all; same as --set run.threads", find_key("run.threads")->range);
  auto* set =
      command
          ->add_option("--set", arguments->assignments,
                       "key=value, any key of the case file by its dotted path, e.g. capsule.0.radius=8; "
                       "may be given many times")
          ->allow_extra_args(false);
  auto* shear_time = add_number(*command, "--shear-time", arguments->shear_time,
                                "End of the run in shear times; same as --set run.shear_time; extends a "
                                "finished run with --resume",
                                find_key("run.shear_time")->range);
  auto* resume = command->add_option("--resume", arguments->resume,
                                     "Go on from the last checkpoint of this output directory");
  auto* from_step =
      add_number(*command, "--from-step", arguments->from_step,
                 "With --resume: from the checkpoint of this step instead; later ones are set aside in "
                 "DIR/checkpoints until new ones replace them, later output is cut and written anew",
                 between(0, most_steps))
          ->needs(resume);
  command
      ->add_flag("--accept-gaps", arguments->accept_gaps,
                 "With --resume: go on though observables.csv or another table lacks rows that were written "
                 "before the "
                 "checkpoint")
      ->needs(resume);
  add_packet_options(*command, arguments->packets);
  resume->excludes(case_file)->excludes(output)->excludes(force)->excludes(set);
  command->callback([=, &exit_code] {
    if (*resume) {
      ResumeOptions options{arguments->resume, {}, {}, {{}, arguments->accept_gaps}, arguments->packets};
      if (*shear_time) options.shear_time = arguments->shear_time;
      if (*threads) options.threads = arguments->threads;
      if (*from_step) options.from.step = arguments->from_step;
      exit_code = run_resumed(options);
      return;
    }
    if (!*case_file)
      throw InputError("tanktread run: a case file (or --resume DIR) is needed; see tanktread run --help");
    if (*threads) arguments->assignments.push_back(fmt::format("run.threads={}", arguments->threads));
    if (*shear_time)
      arguments->assignments.push_back(fmt::format("run.shear_time={}", arguments->shear_time));
    exit_code = run_case(*arguments);
  });
}

}  // namespace tanktread::driver
