// The ranks beside the first.
#pragma once

#include "ranks/world.hpp"

namespace tanktread::driver {

/// What a rank other than the first does: it holds its parts of what the first rank makes, of a fluid
/// (FluidOnRanks) or a whole system (ManyRanks), and obeys, until end_followers().
void follow(const ranks::World& world);

/// On the first rank: the others come back from follow(). Nothing if there are none.
void end_followers(const ranks::World& world);

}  // namespace tanktread::driver
