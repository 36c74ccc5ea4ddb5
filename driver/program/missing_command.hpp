// Subcommands that this program is built without: --help names them, and calling one is an error.
#pragma once

#include <string>

#include "driver/program/commands.hpp"

namespace tanktread::driver {

/// Adds a command that says what is missing, whatever its arguments. @param needs the components that it
/// needs: "the membrane" @throws InputError when it is called
void add_missing_command(CLI::App& app, const std::string& name, const std::string& needs);

/// Refuses what a program without some component cannot do.
/// @param what "tanktread replay --only fluid" @throws InputError
[[noreturn]] void refuse_missing(const std::string& what, const std::string& needs);

/// Lists the missing commands below `app` after all others.
void put_missing_last(CLI::App& app);

/// Lists a command among the missing ones if all commands below it are. @param needs as above
void mark_if_all_missing(CLI::App& command, const std::string& needs);

}  // namespace tanktread::driver
