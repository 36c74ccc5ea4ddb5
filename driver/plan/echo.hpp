// The echo of a case: what follows from it, as text for a person.
#pragma once

#include <string>
#include <vector>

#include "driver/plan/cost.hpp"
#include "driver/plan/echo_load.hpp"
#include "driver/plan/shape_numbers.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// The echo: aligned text in sections, at most 100 columns wide (the title apart): one line a number, with
/// its SI value if the case has [si], and formula; it ends with the cost and the warnings.
/// @param shapes numbers of each capsule; empty: not known yet, and left out
/// @param patches of the loads; empty: likewise
std::string echo(const Case& the_case, const Parameters& parameters, const Cost& cost,
                 const std::vector<std::string>& warnings, const std::vector<ShapeNumbers>& shapes = {},
                 const LoadPatches& patches = {});

}  // namespace tanktread::driver
