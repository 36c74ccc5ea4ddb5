#include "driver/plan/duration.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tanktread::driver {

std::string duration_text(double seconds) {
  constexpr double day = 86400, year = 365.25 * day;
  if (seconds >= 2 * year) return fmt::format("{:.3g} years", seconds / year);
  if (seconds >= 4 * day) return fmt::format("{:.1f} days", seconds / day);
  const auto whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace tanktread::driver
