// What goes wrong in a stage, sorted as in a run: bad input, or a run that went wrong.
#pragma once

#include <exception>
#include <filesystem>
#include <utility>

#include "driver/program/errors.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// Calls a stage.
/// @tparam Failures what its component throws when the run goes wrong
/// @throws InputError in place of a FileError (the files are the user's); RunError in place of a failure
template <class... Failures, class Stage>
void with_stage_errors(Stage stage) {
  try {
    std::forward<Stage>(stage)();
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  } catch (const std::exception& error) {
    if ((... || (dynamic_cast<const Failures*>(&error) != nullptr))) throw RunError(error.what());
    throw;
  }
}

/// An output that cannot be written must not be found out after the work. @throws InputError if the file's
/// folder is not there, or the file is a folder
inline void require_place(const std::filesystem::path& file) {
  const auto folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(file.string() + ": there is no folder " + folder.string() +
                     "; make it, or give another name");
  }
  if (std::filesystem::is_directory(file))
    throw InputError(file.string() + ": is a folder; give the name of a file");
}

}  // namespace tanktread::driver
