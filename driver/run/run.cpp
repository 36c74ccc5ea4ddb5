#include "driver/run/run.hpp"

#include <fmt/format.h>

#include "driver/program/file_system_error.hpp"
#include "driver/program/output_directory.hpp"
#include "driver/program/signals.hpp"
#include "driver/program/version.hpp"
#include "driver/run/checkpoint.hpp"
#include "driver/run/checkpoint_times.hpp"
#include "driver/run/closing.hpp"
#include "driver/run/output.hpp"
#include "driver/run/progress.hpp"
#include "driver/system/run_ranks.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/parameters_file.hpp"
#include "exchange/shell_text.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

void write_parameters(const Plan& plan, const std::filesystem::path& directory, const std::string& commits) {
  exchange::write_text(directory / "parameters.toml", parameters_toml(plan.parameters, commits));
}

/// Ends the progress line, and the run with an error that names its last good state.
[[noreturn]] void stop_broken(const std::string& message, const Engine& engine, Progress& progress,
                              const std::filesystem::path& directory) {
  progress.finish(engine.step());
  const auto folders = checkpoint_folders(directory);
  throw RunError(fmt::format("{}\nlast good state: {}", message,
                             folders.empty() ? "none was written" : folders.back().string()));
}

void check_stays(const std::string& file, const std::string& key, const std::filesystem::path& output) {
  if (file.empty() || !is_place_of_run(output, file)) return;
  throw InputError(
      fmt::format("--output {}: --force would remove {}, {}, with the earlier run; copy it to another "
                  "place and name that, or choose another directory",
                  output.string(), key, file));
}

/// What the run is going to read must not go with the earlier run. @throws InputError
void check_meshes_stay(const Case& the_case, const std::filesystem::path& output) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& capsule = the_case.capsules[k];
    check_stays(capsule.mesh.file, fmt::format("capsule.{}.mesh.file", k), output);
    check_stays(capsule.stress_free.file, fmt::format("capsule.{}.stress_free.file", k), output);
  }
}

void write_checkpoint(Engine& engine, const Output& output, const std::filesystem::path& directory) {
  write_checkpoint(
      engine.step(), [&](const std::filesystem::path& folder) { engine.write_state(folder); },
      output.row_counts(), directory);
}

/// A step and what is due after it. @return the seconds that the files of that took
double advance_and_write(Engine& engine, Output& output, Progress& progress, CheckpointTimes& checkpoints,
                         std::int64_t last_step, const std::filesystem::path& directory) {
  engine.advance();
  const double before = progress.seconds();
  progress.observe(output.write(engine, engine.step() == last_step));
  if (checkpoints.due(engine.step(), before)) {
    write_checkpoint(engine, output, directory);
    checkpoints.wrote(progress.seconds());
    engine.share_out();
  }
  const double files = progress.seconds() - before;
  progress.update(engine.step());
  return files;
}

std::int64_t nodes_of(const Case& the_case) {
  const auto& box = the_case.flow.box;
  return std::int64_t{box[0]} * box[1] * box[2];
}

int run_on(const RunEngine& run, const Plan& plan, Output& output, const std::filesystem::path& directory) {
  auto& engine = *run.engine;
  const std::int64_t first_step = engine.step();
  const std::int64_t last_step = last_step_of(plan.the_case, plan.parameters);
  const auto& times = plan.the_case.run;
  CheckpointTimes checkpoints(schedule_of(times.checkpoint_every, plan.parameters), last_step,
                              times.checkpoint_minutes);
  Progress progress(first_step, last_step, nodes_of(plan.the_case), plan.parameters.shear_rate);
  double files = 0;
  try {
    while (engine.step() < last_step && SignalGuard::caught() == 0)
      files += advance_and_write(engine, output, progress, checkpoints, last_step, directory);
    if (engine.step() > first_step && engine.step() < last_step) {
      const double before = progress.seconds();
      write_checkpoint(engine, output, directory);
      if (run.one_process) run.one_process->stop();
      files += progress.seconds() - before;
    }
  } catch (const RunError& error) {
    stop_broken(error.what(), engine, progress, directory);
  } catch (const exchange::FileError& error) {
    stop_broken(error.what(), engine, progress, directory);
  } catch (const std::filesystem::filesystem_error& error) {
    stop_broken(message_of(error), engine, progress, directory);
  }
  progress.finish(engine.step());
  print_closing(engine.step(), engine.seconds(), plan.the_case, progress, files, directory);
  if (SignalGuard::caught() == 0) return 0;
  if (engine.step() < last_step) {
    fmt::print("stopped by a signal; go on with: tanktread run --resume {}\n",
               exchange::shell_text(directory));
  }
  return 128 + SignalGuard::caught();
}

/// The case of a directory's echo with what the command line changes of it, checked like any other. Its mesh
/// files are not read: the checkpoint holds the meshes.
Case read_echo(const std::filesystem::path& directory, const std::vector<std::string>& assignments) {
  const auto echo = directory / "echo.toml";
  if (!std::filesystem::is_regular_file(echo)) {
    throw InputError(fmt::format(
        "--resume {}: not the output of a run, for it holds no echo.toml; give the directory that "
        "--output named",
        directory.string()));
  }
  return read_case(echo, assignments, {.meshes = false});
}

std::vector<std::string> assignments_of(const ResumeOptions& options) {
  std::vector<std::string> assignments;
  if (options.shear_time) assignments.push_back(fmt::format("run.shear_time={}", *options.shear_time));
  if (options.threads) assignments.push_back(fmt::format("run.threads={}", *options.threads));
  return assignments;
}

/// Memory that a state of the fluid takes.
double bytes_of(const fluid::State& state) {
  std::size_t n_values = 0;
  for (const auto& array : state.arrays) n_values += array.values.size();
  return static_cast<double>(n_values * sizeof(double));
}

/// Of membranes that are left in pieces nothing is said.
Plan resumed_plan(const Case& the_case, const SavedState& state) {
  if (state.membrane_pieces.empty()) return make_plan(the_case, state.shapes, bytes_of(state.fluid));
  Plan plan{the_case, parameters(the_case), {}, {}, {}, {}};
  plan.echo = fmt::format("{}: {} capsules, in pieces; tanktread plan says what follows from the case\n",
                          the_case.file.string(), the_case.capsules.size());
  return plan;
}

/// Whether there is anything left to do. @throws InputError for an end that cannot be reached from the
/// checkpoint, and for a record without steps
bool goes_on(const ResumeOptions& options, std::int64_t step, std::int64_t last_step,
             std::int64_t former_last_step, double shear_time) {
  if (last_step > step) return true;
  if (last_step < step || former_last_step != step) {
    throw InputError(fmt::format(
        "{}: the checkpoint to go on from is at or beyond that (step {}); give a later time with "
        "--shear-time",
        options.shear_time
            ? fmt::format("--shear-time {}", shear_time)
            : fmt::format("{}: run.shear_time = {}", (options.directory / "echo.toml").string(), shear_time),
        step));
  }
  if (!options.packets.record.empty()) {
    throw InputError(
        "--record: the run is at its end, so there is no step to record; extend it with --shear-time");
  }
  return false;
}

/// The first writing of a resumed run.
void begin_again(const ResumeOptions& options, const Plan& plan, const ResumeStart& start, Output& output) {
  const auto& directory = options.directory;
  make_record_directory(options.packets);
  make_last(directory, start.folder);
  remove_temporary_files(directory);
  if (options.shear_time || options.threads) write_echo(plan.the_case, directory);
  write_parameters(plan, directory, commits_with(directory / "parameters.toml", commit));
  output.resume(start.point);
}

}  // namespace

int run_new(const Plan& plan, const RunOptions& options) {
  const SignalGuard guard;
  check_output_directory(options.output, options.force);
  check_packets(options.packets, options.output, 0, last_step_of(plan.the_case, plan.parameters));
  if (options.force) check_meshes_stay(plan.the_case, options.output);
  // Before anything is written: a program may not start, a mesh may not fit.
  const auto run = make_engine(options.packets, plan.the_case, plan.parameters);
  run.engine->begin(plan.shapes);
  const DirectoryLock lock(options.output);
  check_output_directory(options.output, options.force);  // another process may have been faster
  make_record_directory(options.packets);
  if (options.force) remove_earlier_run(options.output);
  remove_temporary_files(options.output);
  write_echo(plan.the_case, options.output);
  write_parameters(plan, options.output, commit);
  Output output(plan.the_case, plan.parameters, options.output);
  output.begin();
  output.write(*run.engine, false);
  write_checkpoint(*run.engine, output, options.output);
  if (run.one_process) run.one_process->set_passage(make_passage(options.packets, plan, 0, options.output));
  return run_on(run, plan, output, options.output);
}

int run_resumed(const ResumeOptions& options) {
  const SignalGuard guard;
  const auto& directory = options.directory;
  const auto former_case = read_echo(directory, {});
  const auto the_case = read_echo(directory, assignments_of(options));
  const auto of_ranks = ranks_line(the_case);
  find_checkpoint(directory, options.from.step);  // a place without one is not a run's: no lock there
  const DirectoryLock lock(directory);
  const auto numbers = parameters(the_case);
  Output output(the_case, numbers, directory);
  auto from = options.from;
  from.with_pieces = passes_one_process(options.packets, the_case);
  auto start = find_start(directory, the_case, output, from);
  const auto last_step = last_step_of(the_case, numbers);
  if (!goes_on(options, start.point.step, last_step, last_step_of(former_case, numbers),
               the_case.run.shear_time)) {
    remove_temporary_files(directory);
    remove_old_checkpoints(directory);
    fmt::print("the run is at its end; --shear-time extends it\n");
    return 0;
  }
  check_packets(options.packets, directory, start.point.step, last_step);
  const auto plan = resumed_plan(the_case, start.state);
  fmt::print("{}{}resuming from {}\n", plan.echo, of_ranks, start.folder.string());
  if (!start.state.the_case) {
    fmt::print(
        "note: the checkpoint is of an earlier version and does not hold its case: echo.toml is taken as "
        "it is, compared with nothing\n");
  }
  const auto run = make_engine(options.packets, the_case, plan.parameters);
  restore_start(*run.engine, start, directory, the_case, output);
  start.state = {};  // as large as the lattice itself
  begin_again(options, plan, start, output);
  if (run.one_process)
    run.one_process->set_passage(make_passage(options.packets, plan, start.point.step, directory));
  return run_on(run, plan, output, directory);
}

}  // namespace tanktread::driver
