#include "driver/program/number_range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tanktread::driver {

bool NumberRange::contains(double value) const {
  const bool above = least_included ? value >= least : value > least;
  const bool below = greatest_included ? value <= greatest : value < greatest;
  return std::isfinite(value) && above && below;
}

std::string NumberRange::text() const {
  const auto low = std::isfinite(least) ? fmt::format(" {} {}", least_included ? ">=" : ">", least) : "";
  const auto high =
      std::isfinite(greatest) ? fmt::format(" {} {}", greatest_included ? "<=" : "<", greatest) : "";
  return low + (low.empty() || high.empty() ? "" : " and") + high;
}

}  // namespace tanktread::driver
