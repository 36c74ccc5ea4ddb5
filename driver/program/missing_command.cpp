#include "driver/program/missing_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

const std::string missing_group = "Left out of this program";

bool is_missing(const CLI::App* command) {
  return command->get_group() == missing_group;
}

void mark_missing(CLI::App& command, const std::string& needs) {
  command.description("needs " + needs);
  command.group(missing_group);
}

}  // namespace

void add_missing_command(CLI::App& app, const std::string& name, const std::string& needs) {
  auto* command = app.add_subcommand(name)->prefix_command();
  command->set_help_flag();  // so that --help too says what is missing
  mark_missing(*command, needs);
  command->callback([=, path = app.get_name() + " " + name] { refuse_missing(path, needs); });
}

void refuse_missing(const std::string& what, const std::string& needs) {
  throw InputError(
      fmt::format("{}: left out of this program, since it needs {}; use one that is built with all that "
                  "(TANKTREAD_COMPONENTS, see README.md)",
                  what, needs));
}

void put_missing_last(CLI::App& app) {
  for (auto* command : app.get_subcommands(is_missing)) {
    const auto kept = app.get_subcommand_ptr(command);
    app.remove_subcommand(command);
    app.add_subcommand(kept);
  }
}

void mark_if_all_missing(CLI::App& command, const std::string& needs) {
  const auto below = command.get_subcommands([](const CLI::App*) { return true; });
  if (std::ranges::all_of(below, is_missing)) mark_missing(command, needs);
}

}  // namespace tanktread::driver
