// A program without the fluid.
#include "driver/missing_command.hpp"

namespace tanktread::driver {

void add_fluid_command(CLI::App& app, int&) {
  add_missing_command(app, "fluid", "the fluid");
}

}  // namespace tanktread::driver
