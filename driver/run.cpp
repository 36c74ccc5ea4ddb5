#include "driver/run.hpp"

#include <fmt/format.h>

#include <csignal>

#include "driver/checkpoint.hpp"
#include "driver/output.hpp"
#include "driver/progress.hpp"
#include "driver/step.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

volatile std::sig_atomic_t caught_signal = 0;
void catch_signal(int signal) {
  caught_signal = signal;
}

/// Takes SIGINT and SIGTERM while it lives, so that a run can end with a checkpoint.
class SignalGuard {
 public:
  SignalGuard()
      : interrupt_(std::signal(SIGINT, catch_signal)), terminate_(std::signal(SIGTERM, catch_signal)) {
    caught_signal = 0;
  }
  ~SignalGuard() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

void prepare_directory(const RunOptions& options) {
  const auto& directory = options.output;
  if (std::filesystem::exists(directory) && !std::filesystem::is_empty(directory)) {
    if (!options.force) {
      throw InputError(
          fmt::format("--output {}: the directory is not empty and is never overwritten by itself; choose "
                      "another, add --force to remove the earlier run, or go on from it with --resume {}",
                      directory.string(), directory.string()));
    }
    if (!std::filesystem::exists(directory / "echo.toml")) {
      throw InputError(
          fmt::format("--output {}: --force removes an earlier run only, and there is none (no echo.toml); "
                      "choose another directory",
                      directory.string()));
    }
    for (const char* name : {"echo.toml", "echo.txt", "observables.csv", "membrane.pvd", "membrane",
                             "fluid.pvd", "fluid", "checkpoints"}) {
      std::filesystem::remove_all(directory / name);
    }
  }
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error)
    throw InputError(fmt::format("--output {}: cannot be made: {}", directory.string(), error.message()));
}

void write_echo(const Plan& plan, const std::filesystem::path& directory) {
  exchange::write_text(directory / "echo.toml", to_toml(plan.the_case));
}

/// The last lines of a run: where it ended, how fast it was, which component took how much.
void print_closing(const System& system, const Progress& progress, const std::filesystem::path& directory) {
  const auto& seconds = system.seconds;
  const double total = seconds.fluid + seconds.coupler + seconds.membrane;
  if (total > 0) {
    fmt::print("cost: fluid {:.1f} %, coupler {:.1f} %, membrane {:.1f} % of {}\n",
               100 * seconds.fluid / total, 100 * seconds.coupler / total, 100 * seconds.membrane / total,
               duration_text(total));
  }
  fmt::print("ended at step {} with {:.1f} MLUPS; results are in {}\n", system.step,
             progress.mlups(system.step), directory.string());
}

[[noreturn]] void stop_broken(const RunError& error, const std::filesystem::path& directory) {
  const auto folders = checkpoint_folders(directory);
  throw RunError(fmt::format("{}\nlast good state: {}", error.what(),
                             folders.empty() ? "none was written" : folders.back().string()));
}

int run_on(System& system, const Plan& plan, Output& output, const std::filesystem::path& directory) {
  const std::int64_t last_step = steps_of(plan.the_case.run.shear_time, plan.parameters);
  const auto checkpoints = schedule_of(plan.the_case.run.checkpoint_every, plan.parameters);
  Progress progress(system.step, last_step, system.fluid->shape().size(), plan.parameters.shear_rate);
  const SignalGuard guard;
  while (system.step < last_step && caught_signal == 0) {
    try {
      advance(system);
    } catch (const RunError& error) {
      progress.finish(system.step);
      stop_broken(error, directory);
    }
    progress.observe(output.write(system, system.step == last_step));
    if (checkpoints.due(system.step) || system.step == last_step) write_checkpoint(system, directory);
    progress.update(system.step);
  }
  if (system.step < last_step) write_checkpoint(system, directory);
  progress.finish(system.step);
  print_closing(system, progress, directory);
  if (system.step < last_step) {
    fmt::print("stopped by a signal; go on with: tanktread run --resume {}\n", directory.string());
    return 128 + caught_signal;
  }
  return 0;
}

}  // namespace

int run_new(const Plan& plan, const RunOptions& options) {
  prepare_directory(options);
  write_echo(plan, options.output);
  auto system = make_system(plan.the_case, plan.parameters, plan.meshes);
  Output output(plan.the_case, plan.parameters, options.output);
  output.begin();
  output.write(system, false);
  write_checkpoint(system, options.output);
  return run_on(system, plan, output, options.output);
}

int run_resumed(const std::filesystem::path& directory, std::optional<double> shear_time,
                std::optional<int> threads) {
  auto the_case = read_case(directory / "echo.toml");
  if (shear_time) the_case.run.shear_time = *shear_time;
  if (threads) the_case.run.threads = *threads;
  const auto checkpoint = read_last_checkpoint(directory);
  const auto plan = make_plan(the_case, checkpoint.references);
  fmt::print("{}resuming from {}\n", plan.echo, checkpoint.folder.string());
  if (steps_of(the_case.run.shear_time, plan.parameters) < checkpoint.step) {
    throw InputError(fmt::format("--shear-time {}: the run is already at {:.6g}; give a later time",
                                 the_case.run.shear_time,
                                 static_cast<double>(checkpoint.step) * plan.parameters.shear_rate));
  }
  if (steps_of(the_case.run.shear_time, plan.parameters) == checkpoint.step) {
    fmt::print("the run is at its end; --shear-time extends it\n");
    return 0;
  }
  auto system = make_system(the_case, plan.parameters, checkpoint.references);
  restore(system, checkpoint);
  if (shear_time) write_echo(plan, directory);
  Output output(the_case, plan.parameters, directory);
  output.resume(checkpoint.step);
  return run_on(system, plan, output, directory);
}

}  // namespace tanktread::driver
