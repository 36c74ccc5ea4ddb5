// A plan for many ranks as text for a person.
#pragma once

#include <string>

#include "driver/plan/plan.hpp"
#include "driver/plan/rank_plan.hpp"

namespace tanktread::driver {

/// What the ranks of a division would have and take, in the layout of the echo; a table of fewer ranks, to
/// see where more stop paying; warnings.
std::string rank_report(const Plan& plan, const ranks::Division& division);

}  // namespace tanktread::driver
