// A program without the fluid or the coupler.
#include "driver/program/missing_command.hpp"

namespace tanktread::driver {

void add_layers_study(CLI::App& study, int&) {
  add_missing_command(study, "layers", "the fluid and the coupler");
}

}  // namespace tanktread::driver
