#include "driver/stages/replay_component.hpp"
#include "driver/system/components.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

void feed(ReplayRecord& record, const Case& the_case) {
  const auto coupler = make_coupler(the_case);
  const auto corrections = make_node_corrections(the_case, *coupler);
  const auto inside = record.has_marks() ? make_inside(the_case) : nullptr;
  if (inside) {
    const auto start = record.surfaces_before(record.first_step());
    mark_inside(*inside, start.positions, start.triangles, true);
  }
  for (auto step = record.first_step(); step <= record.last_step(); ++step) {
    const auto before = record.surfaces_before(step);
    build_stencils(*coupler, corrections, before.positions, before.triangles);
    record.compare(Packet::node_velocity, step,
                   velocity_of_nodes(*coupler, corrections, record.grid(Packet::grid_velocity, step, true),
                                     before, record.force_before(step)));
    record.compare(Packet::grid_force, step,
                   spread(*coupler, corrections, record.nodes(Packet::positions, step), before.triangles,
                          record.nodes(Packet::node_force, step)));
    if (!inside) continue;
    const auto news = mark_inside(*inside, record.nodes(Packet::positions, step), before.triangles);
    record.compare(step, news, inside->marks());
  }
}

}  // namespace

void replay_coupler(ReplayRecord& record, const Case& the_case) {
  try {
    feed(record, the_case);
  } catch (const coupler::StencilError& error) {
    throw InputError(error.what());
  } catch (const coupler::InsideError& error) {
    throw InputError(error.what());
  } catch (const coupler::CorrectionError& error) {
    throw InputError(error.what());
  }
}

}  // namespace tanktread::driver
