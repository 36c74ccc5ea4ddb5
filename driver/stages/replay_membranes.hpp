// The membranes of a record, for the components that go on with them.
#pragma once

#include <vector>

#include "driver/stages/replay_component.hpp"
#include "driver/system/capsule_membrane.hpp"

namespace tanktread::driver {

/// At the beginning of the record. @throws std::invalid_argument if they do not fit the case
std::vector<CapsuleMembrane> membranes_at_begin(const ReplayRecord& record, const Case& the_case);

/// Compares their state with that at the end of the record.
void compare_end(ReplayRecord& record, const std::vector<CapsuleMembrane>& membranes);

}  // namespace tanktread::driver
