// tanktread: capsules and red blood cells in flow. Exit codes: 0 done, 1 diff found a difference, 2 bad
// input, 3 a run went wrong, 130/143 signal.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "driver/case/spelling.hpp"
#include "driver/command_line.hpp"
#include "driver/program/errors.hpp"

namespace {

constexpr int exit_bad_input = 2;
constexpr int exit_run_failed = 3;

int fail(int code, const char* message) {
  fmt::print(stderr, "tanktread: error: {}\n", message);
  return code;
}

/// CLI11 would only say that a subcommand is required. @throws InputError for a first word that is none
void check_subcommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::ranges::find(names, argv[1]) != names.end()) return;
  const auto similar = tanktread::driver::nearest_spelling(argv[1], names);
  throw tanktread::driver::InputError(fmt::format(
      "'{}' is no subcommand; {}", argv[1],
      similar.empty() ? "tanktread --help lists them" : fmt::format("did you mean {}?", similar)));
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto app = tanktread::driver::command_line(exit_code);
  try {
    check_subcommand(*app, argc, argv);
    app->parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? 0 : exit_bad_input;
  } catch (const tanktread::driver::InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const std::exception& error) {
    return fail(exit_run_failed, error.what());
  }
}
