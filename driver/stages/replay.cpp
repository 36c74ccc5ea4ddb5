#include "driver/stages/replay.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "driver/stages/replay_component.hpp"
#include "driver/stages/stage_errors.hpp"

namespace tanktread::driver {
namespace {

void replay_component(ReplayRecord& record, const std::string& component, const Case& the_case) {
  try {
    if (component == "membrane") {
      replay_membrane(record, the_case);
    } else if (component == "implicit") {
      replay_implicit(record, the_case);
    } else if (component == "coupler") {
      replay_coupler(record, the_case);
    } else {
      replay_fluid(record, the_case);
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("the record does not fit the settings: {}", error.what()));
  }
}

}  // namespace

std::vector<ReplayedArray> replay(const ReplayOptions& options) {
  std::vector<ReplayedArray> result;
  with_stage_errors([&] {
    ReplayRecord record(options);
    // The meshes are in the record; of the programs the component's own is started.
    const FilesUsed used{.meshes = false,
                         .fluid_program = options.component == "fluid",
                         .membrane_programs = options.component == "membrane"};
    replay_component(record, options.component,
                     read_case(options.record / "echo.toml", options.assignments, used));
    result = record.differences();
  });
  return result;
}

}  // namespace tanktread::driver
