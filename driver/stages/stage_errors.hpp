// What goes wrong in a stage, sorted as in a run: bad input, or a run that went wrong.
#pragma once

#include <exception>
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

}  // namespace tanktread::driver
