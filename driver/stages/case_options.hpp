// The options that say the case of a stage.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// --case and --set of a stage.
struct CaseOptions {
  std::string file;
  std::vector<std::string> assignments;

  void add_to(CLI::App& command) {
    command.add_option("--case", file, "Case file, or the echo.toml of a run")->required();
    command.add_option("--set", assignments, "key=value, as for run")->allow_extra_args(false);
  }
  /// @param used what of the files that the case names the stage reads
  Case read(const FilesUsed& used) const { return read_case(file, assignments, used); }
};

}  // namespace tanktread::driver
