// The section of the echo on a capsule.
#pragma once

#include <cstddef>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"
#include "driver/plan/shape_numbers.hpp"

namespace tanktread::driver {

/// @param number_of_it its place in the case @param shape numbers that are 0 are not known, and left out
void put_capsule(EchoTable& table, const Subject& subject, std::size_t number_of_it,
                 const ShapeNumbers& shape);

}  // namespace tanktread::driver
