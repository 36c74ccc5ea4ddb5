// The section of the echo on a capsule.
#pragma once

#include <cstddef>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"

namespace tanktread::driver {

/// @param number_of_it its place in the case; mean_edge in grid steps, 0: not known, and left out
void put_capsule(EchoTable& table, const Subject& subject, std::size_t number_of_it, double mean_edge);

}  // namespace tanktread::driver
