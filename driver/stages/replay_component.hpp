// Each component at work on a record. Where the program lacks the component, the function of that name is the
// one in driver/absent/, which says so.
#pragma once

#include "driver/case/case.hpp"
#include "driver/stages/replay_record.hpp"

namespace tanktread::driver {

/// What is fed and compared: replay.hpp. @throws std::invalid_argument if the record does not fit the case;
/// InputError, RunError
void replay_membrane(ReplayRecord& record, const Case& the_case);
void replay_implicit(ReplayRecord& record, const Case& the_case);
void replay_coupler(ReplayRecord& record, const Case& the_case);
void replay_fluid(ReplayRecord& record, const Case& the_case);

}  // namespace tanktread::driver
