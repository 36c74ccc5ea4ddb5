#include "driver/study/study_kernel.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/coupler.hpp"
#include "driver/study/study_check.hpp"

namespace tanktread::driver {

std::string kernel_table(const KernelStudy& study) {
  require(study.points >= 2 && study.points <= KernelStudy::most_points && study.points % 2 == 0,
          fmt::format("points is {}, must be even, from 2 to {}", study.points, KernelStudy::most_points));
  const auto& kernel = coupler::kernel(study.kernel);
  const auto n = std::lround(kernel.half_width * study.points);
  std::string table = kernel_table_header;
  for (long k = 0; k <= n; ++k) {
    const double distance = static_cast<double>(k) / study.points;
    table += fmt::format("{},{:.17g},{:.17g}\n", kernel.name, distance, kernel.function(distance));
  }
  return table;
}

}  // namespace tanktread::driver
