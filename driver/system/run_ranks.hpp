// The ranks that this program runs on, and how they share the box of a case.
#pragma once

#include <string>

#include "driver/case/case.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// Set by main() before all else; null: this one alone. A process has one MPI, so there is one of these too.
void set_ranks(const ranks::World* world);

/// As set, but null where there is one rank only.
const ranks::World* other_ranks();

/// The box of a case as it can be divided: its walls, and the nodes that the fluid needs in a part.
ranks::Box box_of_ranks(const Case& the_case);

/// How `n_ranks` ranks share the box: as run.ranks says, or with the least surface of the cuts.
/// @throws InputError naming run.ranks or the number of ranks
ranks::Division division_of(const Case& the_case, int n_ranks);

/// What a run says of them: "on 2 ranks (Open MPI v4.1.4) of 4 threads: 1 x 1 x 2 parts, the first of 60 x 60
/// x 30 nodes", and a warning if these threads have fewer processors than they are; "" on one. @throws
/// InputError if run.ranks is for another number of them
std::string ranks_line(const Case& the_case);

}  // namespace tanktread::driver
