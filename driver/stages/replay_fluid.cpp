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
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    record.compare(Packet::grid_velocity, step,
                   grid_velocity(*fluid, record.grid(Packet::grid_velocity, step, true).nodes));
    if (record.has_implicit()) {
      record.compare(Packet::free_velocity, step,
                     free_velocity(*fluid, record.grid(Packet::free_velocity, step, true).nodes));
    }
    if (record.has_marks()) set_viscosity(*fluid, record.marks(step), viscosities);
    advance_fluid(*fluid, record.grid(Packet::grid_force, step));
  }
  record.compare_end(state_file(fluid->state(), fluid->shape()));
}

}  // namespace

void replay_fluid(ReplayRecord& record, const Case& the_case) {
  with_stage_errors<fluid::Breakdown>([&] { feed(record, the_case); });
}

}  // namespace tanktread::driver
