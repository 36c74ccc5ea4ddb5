#include "coupler/coupler.hpp"
#include "driver/case/names.hpp"

namespace tanktread::driver {

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const auto& kernel : coupler::kernels()) names.push_back(kernel.name);
  return names;
}

std::optional<double> kernel_half_width(const std::string& kernel) {
  return coupler::kernel(kernel).half_width;
}

bool is_corrected_by_default(const std::string& kernel) {
  return coupler::kernel(kernel).gains_by_correction;
}

}  // namespace tanktread::driver
