// tanktread: capsules and red blood cells in flow. Exit codes: 0 done, 1 diff found a difference, 2 bad
// input, 3 a run went wrong, 130/143 signal.
#include <fmt/format.h>

#include <cstdio>

#include "driver/case.hpp"
#include "driver/commands.hpp"
#include "driver/missing_command.hpp"
#include "driver/version.hpp"

namespace {

constexpr int exit_bad_input = 2;
constexpr int exit_run_failed = 3;

int fail(int code, const char* message) {
  fmt::print(stderr, "tanktread: error: {}\n", message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "tanktread: capsules with elastic and viscous membranes in flow, by immersed boundary and lattice "
      "Boltzmann",
      "tanktread");
  app.set_version_flag("--version", std::string("tanktread ") + tanktread::driver::version);
  app.require_subcommand(1);
  int exit_code = 0;
  tanktread::driver::add_run_command(app, exit_code);
  tanktread::driver::add_plan_command(app, exit_code);
  tanktread::driver::add_membrane_command(app, exit_code);
  tanktread::driver::add_coupler_command(app, exit_code);
  tanktread::driver::add_fluid_command(app, exit_code);
  tanktread::driver::add_replay_command(app, exit_code);
  tanktread::driver::add_mesh_command(app, exit_code);
  tanktread::driver::add_study_command(app, exit_code);
  tanktread::driver::add_diff_command(app, exit_code);
  tanktread::driver::put_missing_last(app);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_bad_input;
  } catch (const tanktread::driver::InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const std::exception& error) {
    return fail(exit_run_failed, error.what());
  }
}
