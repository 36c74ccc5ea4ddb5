// What a plan says of the length of the step: which error it makes, and how long it may be.
#pragma once

#include <string>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"

namespace tanktread::driver {

/// Rows of the echo: the error of the case's step, and the wall speed that would keep half a per cent of D.
/// None for a case that is not within what was measured.
void put_step(EchoTable& table, const Subject& subject);

/// A line for `plan --accuracy`: the largest step at the case's tau+ that keeps D within that share, as an
/// assignment to paste; or why that is not known.
std::string accuracy_line(const Case& the_case, const Parameters& parameters, double accuracy);

}  // namespace tanktread::driver
