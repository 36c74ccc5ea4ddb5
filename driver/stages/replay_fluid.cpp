#include "driver/packets/fluid_files.hpp"
#include "driver/stages/replay_component.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/system/components.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

void feed(ReplayRecord& record, const Case& the_case) {
  const auto fluid = make_fluid(the_case, flow_parameters(the_case));
  fluid->restore(record.begin().fluid);
  const auto viscosities = viscosities_of_marks(the_case);
  const bool has_marks = record.has_marks();
  if (has_contrast(the_case) && !has_marks) {
    throw InputError(
        "the record holds no packets inside, for the viscosity of its run was the same everywhere; "
        "without them viscosity_ratio must be 1");
  }
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    record.compare(Packet::grid_velocity, step,
                   grid_velocity(*fluid, record.grid(Packet::grid_velocity, step, true).nodes));
    if (record.has_implicit()) {
      record.compare(Packet::free_velocity, step,
                     free_velocity(*fluid, record.grid(Packet::free_velocity, step, true).nodes));
    }
    // At first of all nodes: the viscosities of the state are those of the settings that made it.
    if (has_marks) set_viscosity(*fluid, record.marks(step, step == record.first_step()), viscosities);
    advance_fluid(*fluid, record.grid(Packet::grid_force, step));
  }
  record.compare_end(state_file(fluid->state(), fluid->shape()));
}

}  // namespace

void replay_fluid(ReplayRecord& record, const Case& the_case) {
  with_stage_errors<fluid::Breakdown>([&] { feed(record, the_case); });
}

}  // namespace tanktread::driver
