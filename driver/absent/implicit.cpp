// A program without the membrane or the coupler, which find implicit viscous forces together.
#include "driver/program/missing_command.hpp"
#include "driver/stages/replay_component.hpp"

namespace tanktread::driver {

void add_implicit_command(CLI::App& app, int&) {
  add_missing_command(app, "implicit", "the membrane and the coupler");
}

void replay_implicit(ReplayRecord&, const Case&) {
  refuse_missing("tanktread replay --only implicit", "the membrane and the coupler");
}

}  // namespace tanktread::driver
