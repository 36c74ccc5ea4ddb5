#include "driver/stages/replay.hpp"

#include <fmt/format.h>

#include "driver/components.hpp"
#include "driver/stages/fluid_files.hpp"
#include "driver/stages/membrane_files.hpp"
#include "driver/stages/phases.hpp"
#include "driver/stages/replay_record.hpp"
#include "driver/stages/stage_errors.hpp"

namespace tanktread::driver {
namespace {

/// The positions that a step begins with.
NodeVectors positions_before(const ReplayRecord& record, std::int64_t step) {
  return step == record.first_step() ? record.begin().positions : record.nodes(Packet::positions, step - 1);
}

void replay_membrane(ReplayRecord& record, const Case& the_case) {
  const auto& begin = record.begin();
  auto membranes = make_membranes(the_case, parameters(the_case), begin.references);
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    membranes[k].set_positions(begin.positions[k]);
    membranes[k].restore(begin.membranes[k]);
  }
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    const auto velocity = record.nodes(Packet::node_velocity, step);
    record.compare(Packet::positions, step, move_nodes(positions_before(record, step), velocity));
    record.compare(Packet::node_force, step,
                   nodal_forces(membranes, record.nodes(Packet::positions, step), velocity, step));
  }
  auto end = surface_file(surfaces_of(membranes), record.last_step());
  add_state(end, membranes);
  record.compare_end(end);
}

void replay_coupler(ReplayRecord& record, const Case& the_case) {
  const auto coupler = make_coupler(the_case);
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    const auto before = positions_before(record, step);
    build_stencils(*coupler, before);
    record.compare(Packet::node_velocity, step,
                   interpolate(*coupler, record.grid(Packet::grid_velocity, step, true), before));
    record.compare(
        Packet::grid_force, step,
        spread(*coupler, record.nodes(Packet::positions, step), record.nodes(Packet::node_force, step)));
  }
}

void replay_fluid(ReplayRecord& record, const Case& the_case) {
  const auto fluid = make_fluid(the_case, flow_parameters(the_case));
  fluid->restore(record.begin().fluid);
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    record.compare(Packet::grid_velocity, step,
                   grid_velocity(*fluid, record.grid(Packet::grid_velocity, step, true).nodes));
    advance_fluid(*fluid, record.grid(Packet::grid_force, step));
  }
  record.compare_end(state_file(fluid->state(), fluid->shape()));
}

void replay_component(ReplayRecord& record, const std::string& component, const Case& the_case) {
  try {
    if (component == "membrane") {
      replay_membrane(record, the_case);
    } else if (component == "coupler") {
      replay_coupler(record, the_case);
    } else {
      replay_fluid(record, the_case);
    }
  } catch (const coupler::StencilError& error) {
    throw InputError(error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("the record does not fit the settings: {}", error.what()));
  }
}

}  // namespace

std::vector<ReplayedArray> replay(const ReplayOptions& options) {
  std::vector<ReplayedArray> result;
  with_stage_errors<fluid::Breakdown, LongMove, membrane::InvertedElement>([&] {
    ReplayRecord record(options);
    replay_component(record, options.component, read_case(options.record / "echo.toml", options.assignments));
    result = record.differences();
  });
  return result;
}

}  // namespace tanktread::driver
