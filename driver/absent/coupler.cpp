// A program without the coupler: a case may name any kernel.
#include "driver/case/case.hpp"
#include "driver/case/names.hpp"
#include "driver/program/missing_command.hpp"
#include "driver/stages/replay_component.hpp"

namespace tanktread::driver {

void add_coupler_command(CLI::App& app, int&) {
  add_missing_command(app, "coupler", "the coupler");
}

void replay_coupler(ReplayRecord&, const Case&) {
  refuse_missing("tanktread replay --only coupler", "the coupler");
}

void add_noise_study(CLI::App& study, int&) {
  add_missing_command(study, "strain-rate-noise", "the coupler");
}

void add_kernel_study(CLI::App& study, int&) {
  add_missing_command(study, "kernel", "the coupler");
}

std::vector<std::string> kernel_names() {
  return {};
}

std::optional<double> kernel_half_width(const std::string&) {
  return std::nullopt;
}

/// Without a coupler nothing is corrected; the default kernel has what it has in a whole program, so that its
/// cases are the same.
bool is_corrected_by_default(const std::string& kernel) {
  return kernel == CouplerCase().kernel && CouplerCase().tangential_correction;
}

}  // namespace tanktread::driver
