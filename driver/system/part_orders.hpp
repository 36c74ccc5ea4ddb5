// What the first rank tells the others, and what they answer. Internal to driver/system and driver/engine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "driver/system/fluid_pieces.hpp"
#include "driver/system/halo_by_ranks.hpp"
#include "driver/system/state_from_pieces.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "ranks/packing.hpp"

namespace tanktread::driver {

/// An order begins a message; what follows it, and what is answered:
enum class Order {
  make_part,         ///< Division, settings
  give_up_part,      ///<
  nodes,             ///< the nodes of the next three
  velocity,          ///< ; velocity
  free_velocity,     ///< ; velocity, and a message with the mobility
  dissipation,       ///< ; power
  wall_power,        ///< ; power
  moments,           ///< layers of the box; density, and a message with the velocity, of those of the part
  add_force,         ///< force
  clear_force,       ///<
  force,             ///< ; force
  set_viscosities,   ///< of every node of the part
  set_viscosity_of,  ///< nodes, viscosity
  step,              ///< ; StepAnswer
  state,             ///< ; state
  restore,           ///< state
  make_system,       ///< the case; after make_part
  give_up_system,    ///<
  // After make_system:
  begin,              ///< step; a message with the error, if not all is well
  begin_from_case,    ///< ; as begin
  begin_from_pieces,  ///< step, the index; what was wrong with the pieces, if anything on any rank; as begin
  share_out,          ///<
  advance,            ///< ; a message with the error, if not all is well
  observe,            ///< ; observations
  measures,           ///< ; rows of measures.csv
  energy,             ///< ; PartEnergy
  marks,              ///< ; marks of the nodes of the block
  write_surfaces,     ///< SurfacesToWrite; how it ended ("": well)
  write_pieces,       ///< PiecesOrder; how it ended ("": well)
  // After make_part:
  restore_pieces,  ///< the index; RestoreAnswer
  end,             ///<
};

/// The beginning of a message.
inline ranks::Packing order(Order which) {
  ranks::Packing packing;
  packing.put(which);
  return packing;
}

/// Sends a message of the first rank to all others.
inline void tell_others(const ranks::World& world, std::span<const std::byte> message) {
  for (int rank = 1; rank < world.size(); ++rank) world.send(rank, message);
}

/// How a step of a part ended.
struct StepAnswer {
  double highest_speed = 0;
  bool broke_down = false;
  std::int64_t node = -1;  ///< in the box
  std::string message;
};

inline void pack(ranks::Packing& packing, const StepAnswer& answer) {
  packing.put(answer.highest_speed).put(answer.broke_down).put(answer.node).put_text(answer.message);
}
inline StepAnswer take_step_answer(ranks::Unpacking& unpacking) {
  StepAnswer answer;
  answer.highest_speed = unpacking.take<double>();
  answer.broke_down = unpacking.take<bool>();
  answer.node = unpacking.take<std::int64_t>();
  answer.message = unpacking.take_text();
  return answer;
}

/// A step of a part, whose breakdown is no reason to leave the others alone.
inline StepAnswer step_of(fluid::Fluid& part) {
  try {
    return {part.step(), false, -1, {}};
  } catch (const fluid::Breakdown& error) {
    return {0, true, error.node(), error.what()};
  }
}

inline void pack(ranks::Packing& packing, const fluid::State& state) {
  packing.put(state.step).put(state.arrays.size());
  for (const auto& array : state.arrays)
    packing.put_text(array.name).put(array.components).put_all(array.values);
}
inline fluid::State take_state(ranks::Unpacking& unpacking) {
  fluid::State state;
  state.step = unpacking.take<std::int64_t>();
  state.arrays.resize(unpacking.take<std::size_t>());
  for (auto& array : state.arrays) {
    array.name = unpacking.take_text();
    array.components = unpacking.take<int>();
    array.values = unpacking.take_all<double>();
  }
  return state;
}

/// What a block has of some layers of the box, counted from its own first one.
inline fluid::Layers own_layers(fluid::Layers of_box, const ranks::Block& block) {
  const int begin = std::clamp(of_box.begin - block.begin[2], 0, block.n[2]);
  return {begin, std::clamp(of_box.end - block.begin[2], begin, block.n[2])};
}

/// Density and velocity of the nodes of these layers of a part.
struct Moments {
  std::vector<double> density, velocity;
};
inline Moments moments_of(const fluid::Fluid& part, fluid::Layers layers) {
  const auto shape = part.shape();
  Moments moments;
  moments.density.resize(
      static_cast<std::size_t>(std::int64_t{layers.end - layers.begin} * shape.nx * shape.ny));
  moments.velocity.resize(3 * moments.density.size());
  part.moments_of_layers(layers, moments.density, moments.velocity);
  return moments;
}

/// The part of a rank, all of which call this together.
inline std::unique_ptr<fluid::Fluid> make_part(const ranks::World& world, const ranks::Division& division,
                                               const fluid::LatticeBoltzmannSettings& settings) {
  return fluid::make_lattice_boltzmann(settings, part_of(division, world.rank()),
                                       std::make_unique<HaloByRanks>(world, division));
}

/// What a part says of the power on each of its nodes. @param asked Fluid::dissipation or Fluid::wall_power
inline std::vector<double> power_in(const fluid::Fluid& part,
                                    void (fluid::Fluid::*asked)(std::span<double>) const) {
  std::vector<double> power(static_cast<std::size_t>(part.shape().size()));
  (part.*asked)(power);
  return power;
}

/// Before parts are given up together: what is under way between them comes in, so that no message is left.
inline void end_exchange(const fluid::Fluid& part) {
  part.free_velocity({}, {}, {});
}

}  // namespace tanktread::driver
