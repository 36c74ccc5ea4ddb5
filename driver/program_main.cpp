#include "driver/program_main.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "driver/case/spelling.hpp"
#include "driver/command_line.hpp"
#include "driver/engine/followers.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/file_system_error.hpp"
#include "driver/program/waiting_threads.hpp"
#include "driver/system/run_ranks.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {
namespace {

constexpr int exit_bad_input = 2;
constexpr int exit_run_failed = 3;

constexpr auto no_memory =
    "the memory is not enough for this: something as large as the grid could not be stored; make flow.box "
    "(or the surface) smaller, or end other programs. tanktread plan --no-trial says what a case needs";

int fail(int code, const char* message) {
  fmt::print(stderr, "tanktread: error: {}\n", message);
  return code;
}

/// CLI11 would only say that a subcommand is required. @throws InputError for a word that is none where one
/// must stand
void check_subcommand(const CLI::App& app, int argc, char** argv) {
  const CLI::App* command = &app;
  std::string before;
  for (int k = 1; k < argc && argv[k][0] != '-'; ++k) {
    std::vector<std::string> names;
    for (const auto* below : command->get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(below->get_name());
    if (names.empty()) return;
    if (std::ranges::find(names, argv[k]) == names.end()) {
      const auto similar = nearest_spelling(argv[k], names);
      throw InputError(fmt::format("'{}' is no subcommand{}; {}", argv[k],
                                   before.empty() ? "" : " of" + before,
                                   similar.empty() ? fmt::format("tanktread{} --help lists them", before)
                                                   : fmt::format("did you mean {}?", similar)));
    }
    command = command->get_subcommand(argv[k]);
    before += fmt::format(" {}", argv[k]);
  }
}

/// What CLI11 finds wrong, with the command that it is about, which its own words leave out.
std::string parse_message(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = app.get_name();
  const CLI::App* last = &app;
  for (auto given = last->get_subcommands(); !given.empty(); given = last->get_subcommands()) {
    last = given.front();
    command += " " + last->get_name();
  }
  return fmt::format("{}: {}; see {} --help", command, error.what(), command);
}

/// The command line, on the first rank. @param known set to false after an error that may have left the other
/// ranks in the middle of something
int obey(int argc, char** argv, bool& known) {
  const WaitingThreads waiting_threads;
  int exit_code = 0;
  const auto app = command_line(exit_code);
  try {
    check_subcommand(*app, argc, argv);
    app->parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app->exit(error);  // --help, --version
    return fail(exit_bad_input, parse_message(*app, error).c_str());
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const RunError& error) {
    return fail(exit_run_failed, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    // A run says by itself what goes wrong between its steps; here it is a path that was given.
    return fail(is_of_device(error) ? exit_run_failed : exit_bad_input, message_of(error).c_str());
  } catch (const std::bad_alloc&) {
    known = false;
    return fail(exit_run_failed, no_memory);
  } catch (const std::exception& error) {
    known = false;
    return fail(exit_run_failed, error.what());
  }
}

/// A rank beside the first. Signals are the first one's business.
int follow_first(const ranks::World& world) {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  try {
    const WaitingThreads waiting_threads;
    follow(world);
    return 0;
  } catch (const std::bad_alloc&) {
    fail(exit_run_failed, fmt::format("rank {}: {}", world.rank(), no_memory).c_str());
  } catch (const std::exception& error) {
    fail(exit_run_failed, fmt::format("rank {}: {}", world.rank(), error.what()).c_str());
  }
  std::fflush(nullptr);
  world.abort(exit_run_failed);
}

}  // namespace

int program_main(int argc, char** argv) try {
  const ranks::World world(&argc, &argv);
  if (!world.is_first()) return follow_first(world);
  set_ranks(&world);
  bool known = true;
  const int exit_code = obey(argc, argv, known);
  if (!known && world.size() > 1) {
    std::fflush(nullptr);
    world.abort(exit_code);
  }
  end_followers(world);
  return exit_code;
} catch (const std::runtime_error& error) {
  return fail(exit_run_failed, error.what());  // of MPI, which does not begin
}

}  // namespace tanktread::driver
