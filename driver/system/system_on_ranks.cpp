#include "driver/system/system_on_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "driver/program/errors.hpp"
#include "driver/system/capsule_orders.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/part_orders.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

CapsuleState state_of(const System& system, std::size_t k) {
  const auto& membrane = system.membranes[k];
  return {k, membrane.positions(), system.node_velocity[k], system.node_force[k], membrane.state().history};
}

}  // namespace

SystemOnRanks::SystemOnRanks(FluidOnRanks& fluid, const Case& the_case, const Parameters& parameters)
    : fluid_(fluid), world_(fluid.world()), places_(fluid.division()), own_([&]() -> SystemPart {
        auto message = order(Order::make_system);
        pack(message, the_case);
        tell_others(world_, message.bytes());
        return {fluid.world(), fluid.division(), fluid.own_part(), the_case, parameters};
      }()) {}

SystemOnRanks::~SystemOnRanks() {
  tell_others(world_, order(Order::give_up_system).bytes());
}

int SystemOnRanks::owner_of(const Eigen::Matrix3Xd& positions) const {
  const Eigen::Vector3d middle = positions.rowwise().mean();
  ranks::Triple part;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = places_.n_nodes()[axis];
    const double coordinate =
        places_.is_periodic(axis) ? middle[axis] - n * std::floor(middle[axis] / n) : middle[axis];
    part[axis] = places_.part_of(axis, std::clamp(static_cast<int>(coordinate), 0, n - 1));
  }
  return places_.rank_of(part);
}

void SystemOnRanks::share_out(const System& system) {
  std::vector<int> owners;
  for (const auto& membrane : system.membranes) owners.push_back(owner_of(membrane.positions()));
  if (owners == owners_) return;
  owners_ = std::move(owners);
  std::vector<CapsulesTaken> of_ranks(static_cast<std::size_t>(world_.size()), {system.step, {}, {}});
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    auto& [step, states, shapes] = of_ranks[static_cast<std::size_t>(owners_[k])];
    const auto& reference = system.membranes[k].reference();
    states.push_back(state_of(system, k));
    shapes.meshes.push_back({system.membranes[k].start(), reference.triangles});
    shapes.stress_free.push_back(reference.points);
  }
  for (int rank = 1; rank < world_.size(); ++rank) {
    auto message = order(Order::take_capsules);
    pack(message, of_ranks[static_cast<std::size_t>(rank)]);
    world_.send(rank, message.bytes());
  }
  own_.take(of_ranks[0].step, of_ranks[0].states, of_ranks[0].shapes);
}

void SystemOnRanks::advance(System& system) {
  tell_others(world_, order(Order::advance).bytes());
  const auto step = own_.advance();
  system.seconds = own_.seconds();
  if (!step.all_well) {
    auto first = step.error;
    for (int rank = 1; rank < world_.size(); ++rank) {
      ranks::Unpacking message(world_.receive(rank));
      auto error = take_error(message);
      if (error && (!first || error->is_before(*first))) first = std::move(error);
    }
    throw RunError(first.value().says_step ? first->message
                                           : fmt::format("step {}: {}", system.step + 1, first->message));
  }
  system.highest_speed = step.highest_speed;
  system.viscous_iterations = step.viscous_iterations;
  ++system.step;
}

void SystemOnRanks::collect(System& system) const {
  tell_others(world_, order(Order::collect).bytes());
  const auto take = [&](const std::vector<CapsuleState>& states) {
    for (const auto& state : states) {
      auto& membrane = system.membranes[state.number];
      membrane.set_positions(state.positions);
      membrane.restore({state.history, {}});
      system.node_velocity[state.number] = state.velocity;
      system.node_force[state.number] = state.force;
    }
  };
  take(own_.states());
  for (int rank = 1; rank < world_.size(); ++rank) {
    ranks::Unpacking message(world_.receive(rank));
    take(take_states(message));
  }
  const auto surfaces = surfaces_of(system.membranes);
  build_stencils(*system.coupler, system.corrections, surfaces.positions, surfaces.triangles);
  if (system.inside) mark_inside(*system.inside, surfaces.positions, surfaces.triangles);
}

void SystemOnRanks::write_pieces(const PiecesOrder& what) const {
  auto message = order(Order::write_pieces);
  pack(message, what);
  tell_others(world_, message.bytes());
  auto written = write_piece(
      {world_, fluid_.division(), fluid_.own_part(), fluid_.base_viscosity(), own_.marks()}, what);
  for (int rank = 1; rank < world_.size(); ++rank) {
    auto error = ranks::Unpacking(world_.receive(rank)).take_text();
    if (written.error.empty()) written.error = std::move(error);
  }
  if (!written.error.empty()) throw exchange::FileError(written.error);
  write_index(fluid_.division(), what, written);
}

void share_out(System& system, const Case& the_case, const Parameters& parameters) {
  auto* fluid = dynamic_cast<FluidOnRanks*>(system.fluid.get());
  const auto has_program = [](const CapsuleMembrane& membrane) { return membrane.has_program(); };
  if (fluid == nullptr || std::ranges::any_of(system.membranes, has_program)) return;
  if (!system.on_ranks) system.on_ranks = std::make_unique<SystemOnRanks>(*fluid, the_case, parameters);
  system.on_ranks->share_out(system);
}

void collect(System& system) {
  if (system.on_ranks) system.on_ranks->collect(system);
}

}  // namespace tanktread::driver
