// One time step of the coupled system: numbered phases and nothing else.
#pragma once

#include "driver/program/errors.hpp"
#include "driver/system/passage.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// Advances the system from t to t+1.
/// @throws RunError on NaN, excess speed, a node that moves over half a grid step, an inverted element, a
///         stencil that reaches beyond a wall, a tangential correction from what is not finite. The system is
///         then of no use: go back to a checkpoint.
void advance(System& system);

/// The same; each packet goes from one phase to the next by way of `passage`.
void advance(System& system, Passage& passage);

}  // namespace tanktread::driver
