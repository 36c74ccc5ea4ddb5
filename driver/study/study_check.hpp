// Checks of a study's parameters, with one wording for all studies.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tanktread::driver {

inline void require(bool fine, const std::string& message) {
  if (!fine) throw std::invalid_argument(message);
}

inline void require_positive(const std::string& name, double value) {
  require(std::isfinite(value) && value > 0, fmt::format("{} is {}, must be positive", name, value));
}

}  // namespace tanktread::driver
