// The command line as a whole: all subcommands and their options.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace tanktread::driver {

/// A command line to be parsed once. What a command returns goes to `exit_code`, which must outlive it.
std::unique_ptr<CLI::App> command_line(int& exit_code);

}  // namespace tanktread::driver
