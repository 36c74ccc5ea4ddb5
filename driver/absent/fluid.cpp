// A program without the fluid.
#include "driver/program/missing_command.hpp"
#include "driver/stages/replay_component.hpp"

namespace tanktread::driver {

void add_fluid_command(CLI::App& app, int&) {
  add_missing_command(app, "fluid", "the fluid");
}

void replay_fluid(ReplayRecord&, const Case&) {
  refuse_missing("tanktread replay --only fluid", "the fluid");
}

}  // namespace tanktread::driver
