// `tanktread membrane drag`.
#pragma once

#include <CLI/CLI.hpp>

namespace tanktread::driver {

/// Adds the command below `membrane`. @return it
CLI::App* add_drag_command(CLI::App& membrane, int& exit_code);

}  // namespace tanktread::driver
