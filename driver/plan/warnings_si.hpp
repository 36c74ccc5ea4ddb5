// What is strange about the physical values of a case.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Physical values that no cell, capsule or droplet in a liquid has, as after a slip of the unit, and a
/// density that is run far from the one given. Without [si] none.
std::vector<std::string> si_warnings(const Case& the_case, const Parameters& parameters);

}  // namespace tanktread::driver
