// One time step of the coupled system: numbered phases and nothing else.
#pragma once

#include <stdexcept>

#include "driver/stages/passage.hpp"
#include "driver/system.hpp"

namespace tanktread::driver {

/// The run went wrong and must stop; the message says what, where and at which step. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Advances the system from t to t+1.
/// @throws RunError on NaN, excess speed, a node that moves over half a grid step, an inverted element, a
/// stencil that
///         reaches beyond a wall. The system is then of no use: go back to a checkpoint.
void advance(System& system);

/// The same; each packet goes from one phase to the next by way of `passage`.
void advance(System& system, Passage& passage);

}  // namespace tanktread::driver
