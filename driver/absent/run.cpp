// A program without one of the components that a run puts together.
#include "driver/program/missing_command.hpp"

namespace tanktread::driver {

void add_run_command(CLI::App& app, int&) {
  add_missing_command(app, "run", "the fluid, the membrane and the coupler");
}

void add_plan_command(CLI::App& app, int&) {
  add_missing_command(app, "plan", "the fluid, the membrane and the coupler");
}

}  // namespace tanktread::driver
