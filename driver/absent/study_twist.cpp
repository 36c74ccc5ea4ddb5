// A program without the membrane or the coupler.
#include "driver/program/missing_command.hpp"

namespace tanktread::driver {

void add_twist_study(CLI::App& study, int&) {
  add_missing_command(study, "twisting-sphere", "the membrane and the coupler");
}

}  // namespace tanktread::driver
