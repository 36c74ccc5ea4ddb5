#include "driver/stages/replay_membranes.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/system/components.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {

std::vector<CapsuleMembrane> membranes_at_begin(const ReplayRecord& record, const Case& the_case) {
  const auto& begin = record.begin();
  auto membranes = make_membranes(the_case, parameters(the_case), begin.shapes);
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    membranes[k].set_positions(begin.positions[k]);
    membranes[k].restore(begin.membranes[k]);
  }
  return membranes;
}

void compare_end(ReplayRecord& record, const std::vector<CapsuleMembrane>& membranes) {
  auto end = surface_file(surfaces_of(membranes), record.last_step());
  add_state(end, membranes);
  record.compare_end(end);
}

namespace {

void feed(ReplayRecord& record, const Case& the_case) {
  auto membranes = membranes_at_begin(record, the_case);
  const bool implicit = any_implicit(membranes);
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    const auto velocity = record.nodes(Packet::node_velocity, step);
    record.compare(Packet::positions, step, move_nodes(record.positions_before(step), velocity));
    record.compare(implicit ? Packet::explicit_force : Packet::node_force, step,
                   nodal_forces(membranes, record.nodes(Packet::positions, step), velocity, step));
  }
  // The state of an implicit viscosity follows from the fluid too: --only implicit.
  if (!implicit) compare_end(record, membranes);
}

}  // namespace

void replay_membrane(ReplayRecord& record, const Case& the_case) {
  with_stage_errors<LongMove, membrane::InvertedElement>([&] { feed(record, the_case); });
}

}  // namespace tanktread::driver
