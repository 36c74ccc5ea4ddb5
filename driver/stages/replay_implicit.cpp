#include <fmt/format.h>

#include "driver/stages/replay_membranes.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/system/components.hpp"
#include "driver/system/implicit_forces.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

void feed(ReplayRecord& record, const Case& the_case) {
  auto membranes = membranes_at_begin(record, the_case);
  if (!any_implicit(membranes)) {
    throw InputError(
        "--only implicit: no capsule has an implicit viscosity (membrane.viscous.scheme), so there is "
        "nothing to "
        "compare; use --only membrane");
  }
  const auto coupler = make_coupler(the_case);
  const auto corrections = make_node_corrections(the_case, *coupler);
  const auto settings = implicit_settings(the_case);
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    const auto positions = record.nodes(Packet::positions, step);
    const auto triangles = record.surfaces_before(step).triangles;
    // For the histories of the membranes; compared by --only membrane.
    nodal_forces(membranes, positions, record.nodes(Packet::node_velocity, step), step);
    build_stencils(*coupler, corrections, positions, triangles);
    auto force = record.nodes(Packet::explicit_force, step);
    add_implicit_forces(membranes, *coupler, corrections, record.grid(Packet::free_velocity, step, true),
                        settings, force);
    record.compare(Packet::node_force, step, force);
  }
  compare_end(record, membranes);
}

}  // namespace

void replay_implicit(ReplayRecord& record, const Case& the_case) {
  with_stage_errors<membrane::InvertedElement, NotConverged>([&] {
    try {
      feed(record, the_case);
    } catch (const coupler::StencilError& error) {
      throw InputError(error.what());
    } catch (const coupler::CorrectionError& error) {
      throw InputError(error.what());
    }
  });
}

}  // namespace tanktread::driver
