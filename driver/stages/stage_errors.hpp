// What goes wrong in a stage, sorted as in a run: bad input, or a run that went wrong.
#pragma once

#include <stdexcept>
#include <utility>

#include "coupler/coupler.hpp"
#include "driver/case.hpp"
#include "driver/run_error.hpp"
#include "driver/stages/phases.hpp"
#include "exchange/vtk_files.hpp"
#include "fluid/fluid.hpp"
#include "membrane/membrane.hpp"

namespace tanktread::driver {

/// Calls a stage. @throws InputError in place of a FileError (the files are the user's); RunError in place of
/// what the components throw
template <class Stage>
void with_stage_errors(Stage stage) {
  try {
    std::forward<Stage>(stage)();
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  } catch (const coupler::StencilError& error) {
    throw InputError(error.what());
  } catch (const fluid::Breakdown& error) {
    throw RunError(error.what());
  } catch (const LongMove& error) {
    throw RunError(error.what());
  } catch (const membrane::InvertedElement& error) {
    throw RunError(error.what());
  }
}

}  // namespace tanktread::driver
