#include "driver/units/stability.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace tanktread::driver {
namespace {

struct Limit {
  std::string_view kernel;
  double plain, corrected;
};

/// A third to two thirds of the least onset seen, by kernel (docs/viscous-membranes.md, "Where a run
/// breaks down").
constexpr std::array<Limit, 5> limits = {{
    {"stockie6", 16, 6},
    {"peskin4", 32, 6},
    {"cosine4", 32, 6},
    {"roma3", 6, 4},
    {"linear2", 1, 0.7},
}};

}  // namespace

double stable_interval_times_spring(const std::string& kernel, bool tangential_correction) {
  const auto limit_of = [&](const Limit& limit) {
    return tangential_correction ? limit.corrected : limit.plain;
  };
  const auto found = std::ranges::find(limits, kernel, &Limit::kernel);
  return limit_of(found != limits.end() ? *found : *std::ranges::min_element(limits, {}, limit_of));
}

}  // namespace tanktread::driver
