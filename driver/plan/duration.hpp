// A time for people.
#pragma once

#include <string>

namespace tanktread::driver {

/// Seconds as "1 h 02 min", "3 min 04 s", "12 s".
std::string duration_text(double seconds);

}  // namespace tanktread::driver
