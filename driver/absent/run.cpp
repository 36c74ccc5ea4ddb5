// A program without one of the components that a run puts together.
#include "driver/engine/followers.hpp"
#include "driver/program/missing_command.hpp"
#include "driver/system/run_ranks.hpp"

namespace tanktread::driver {

void add_run_command(CLI::App& app, int&) {
  add_missing_command(app, "run", "the fluid, the membrane and the coupler");
}

void add_plan_command(CLI::App& app, int&) {
  add_missing_command(app, "plan", "the fluid, the membrane and the coupler");
}

// Of several ranks the first does all there is.
void set_ranks(const ranks::World*) {}
void follow(const ranks::World&) {}
void end_followers(const ranks::World&) {}

}  // namespace tanktread::driver
