// The ranks that a test program runs on.
#pragma once

#include "ranks/world.hpp"

namespace tanktread::ranks::test {

/// Made by main().
inline const World* all_ranks = nullptr;

}  // namespace tanktread::ranks::test
