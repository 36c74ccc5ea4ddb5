#include "driver/system/step.hpp"

#include <fmt/format.h>

#include <utility>

#include "driver/system/phases.hpp"
#include "driver/system/timer.hpp"

namespace tanktread::driver {
namespace {

void advance_phases(System& system, Passage& passage) {
  auto& fluid = *system.fluid;
  auto& coupler = *system.coupler;
  auto& seconds = system.seconds;

  auto& velocity = system.packets.grid_velocity;
  auto& force = system.packets.grid_force;
  auto& before = system.packets.before;
  auto& positions = system.packets.positions;
  const int threads = system.threads;

  // 1. u(t) on the grid nodes that the stencils at x(t) touch.
  velocity = timed(seconds.forced_nodes,
                   [&] { return grid_velocity(fluid, coupler.grid_node_list(), std::move(velocity)); });
  passage.pass(system, Packet::grid_velocity, velocity);

  // 2. u_m(t), with the stencils at x(t) (and F_m(t), for the tangential correction).
  before =
      timed(seconds.membranes, [&] { return surfaces_now(system.membranes, threads, std::move(before)); });
  system.node_velocity = timed(seconds.interpolation, [&] {
    return interpolated_velocity(coupler, velocity, before.positions, std::move(system.node_velocity));
  });
  timed(seconds.correction, [&] {
    correct_velocity(coupler, system.corrections, before, system.node_force, system.node_velocity);
  });
  passage.pass(system, Packet::node_velocity, system.node_velocity);

  // 3. x(t+1).
  positions = timed(seconds.membranes, [&] {
    return move_nodes(before.positions, system.node_velocity, threads, std::move(positions));
  });
  passage.pass(system, Packet::positions, positions);

  // 4. Strain and stress at x(t+1), F_m(t+1) but for implicit viscous forces.
  system.node_force = timed(seconds.membranes, [&] {
    return nodal_forces(system.membranes, positions, system.node_velocity, system.step + 1,
                        std::move(system.node_force));
  });

  // 5. Stencils at x(t+1).
  timed(seconds.stencils, [&] { build_stencils(coupler, system.corrections, positions, before.triangles); });

  // 6. Viscous forces that depend on u_m(t+1), from u(t+1) without F(t+1).
  if (any_implicit(system.membranes)) {
    auto& free = system.packets.free_velocity;
    passage.pass(system, Packet::explicit_force, system.node_force);
    free = timed(seconds.implicit,
                 [&] { return free_velocity(fluid, coupler.grid_node_list(), std::move(free)); });
    passage.pass(system, Packet::free_velocity, free);
    system.viscous_iterations = timed(seconds.implicit, [&] {
      return add_implicit_forces(system.membranes, coupler, system.corrections, free, system.implicit,
                                 system.node_force);
    });
  }
  passage.pass(system, Packet::node_force, system.node_force);

  // 7. F(t+1), with the stencils at x(t+1).
  force =
      timed(seconds.spreading, [&] { return spread_force(coupler, system.node_force, std::move(force)); });
  passage.pass(system, Packet::grid_force, force);

  // 8. The nodes inside capsules at x(t+1).
  if (system.inside) {
    auto news =
        timed(seconds.inside, [&] { return mark_inside(*system.inside, positions, before.triangles); });
    passage.pass(system, Packet::inside, news);
    timed(seconds.inside, [&] { set_viscosity(fluid, news, system.viscosity_of_marks); });
  }

  // 9. The fluid goes to t+1 under F(t+1).
  timed(seconds.forced_nodes, [&] { set_force(fluid, force); });
  system.highest_speed = timed(seconds.fluid, [&] { return fluid.step(); });
  ++system.step;
  passage.step_done(system);
}

}  // namespace

void advance(System& system, Passage& passage) {
  const auto stop = [&system](const std::exception& error) {
    throw RunError(fmt::format("step {}: {}", system.step + 1, error.what()));
  };
  try {
    advance_phases(system, passage);
  } catch (const fluid::Breakdown& error) {
    throw RunError(error.what());  // which says the step
  } catch (const LongMove& error) {
    stop(error);
  } catch (const membrane::InvertedElement& error) {
    stop(error);
  } catch (const coupler::StencilError& error) {
    stop(error);
  } catch (const coupler::CorrectionError& error) {
    stop(error);
  } catch (const coupler::InsideError& error) {
    stop(error);
  } catch (const NotConverged& error) {
    stop(error);
  }
}

void advance(System& system) {
  Passage in_memory;
  advance(system, in_memory);
}

}  // namespace tanktread::driver
