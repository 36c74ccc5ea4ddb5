// The rows of the echo on the shapes of a capsule.
#pragma once

#include <cstddef>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"
#include "driver/plan/shape_numbers.hpp"

namespace tanktread::driver {

/// @param number_of_it its place in the case @param numbers those that are 0 are not known, and left out
void put_shape(EchoTable& table, const Subject& subject, std::size_t number_of_it,
               const ShapeNumbers& numbers);

}  // namespace tanktread::driver
