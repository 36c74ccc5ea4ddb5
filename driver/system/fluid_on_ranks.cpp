#include "driver/system/fluid_on_ranks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "driver/system/part_orders.hpp"

namespace tanktread::driver {
namespace {

using ranks::Packing;
using ranks::Unpacking;

void check_size(const char* what, std::size_t size, std::size_t needed) {
  if (size == needed) return;
  throw std::invalid_argument(std::string("fluid on ranks: ") + what + " has room for " +
                              std::to_string(size) + " numbers, " + std::to_string(needed) + " are needed");
}

/// Before any rank is told: one that refuses could only end all. @throws std::invalid_argument
void check_viscosity(std::span<const double> kinematic_viscosity) {
  for (std::size_t k = 0; k < kinematic_viscosity.size(); ++k) {
    if (std::isfinite(kinematic_viscosity[k]) && kinematic_viscosity[k] > 0) continue;
    throw std::invalid_argument("fluid on ranks: value " + std::to_string(k) +
                                " of the kinematic viscosity is " + std::to_string(kinematic_viscosity[k]) +
                                ", must be > 0 and finite");
  }
}

/// Puts what a rank has of some layers to its place among all their numbers.
void place_layers(std::span<const double> of_part, int components, const ranks::Division& division, int rank,
                  fluid::Layers layers, std::span<double> of_layers) {
  const auto block = division.block(rank);
  const auto own = own_layers(layers, block);
  const auto& box = division.box().n;
  const auto n_row = static_cast<std::size_t>(components) * static_cast<std::size_t>(block.n[0]);
  const double* from = of_part.data();
  for (int z = own.begin; z < own.end; ++z) {
    for (int y = 0; y < block.n[1]; ++y, from += n_row) {
      const std::int64_t layer = block.begin[2] + z - layers.begin;
      const auto node = (layer * box[1] + block.begin[1] + y) * box[0] + block.begin[0];
      std::copy_n(from, n_row, &of_layers[static_cast<std::size_t>(components * node)]);
    }
  }
}

}  // namespace

FluidOnRanks::FluidOnRanks(const ranks::World& world, const ranks::Division& division,
                           const fluid::LatticeBoltzmannSettings& settings)
    : world_(world),
      division_(division),
      shape_(settings.shape),
      base_viscosity_(fluid::viscosity_of(settings)),
      asked_(division),
      changed_(division) {
  auto message = order(Order::make_part);
  message.put(division.box()).put(division.parts()).put(settings);
  tell_others(world_, message.bytes());
  own_ = make_part(world, division, settings);
}

FluidOnRanks::~FluidOnRanks() {
  tell_others(world_, order(Order::give_up_part).bytes());
  end_exchange(*own_);
}

const std::vector<NodeShare>& FluidOnRanks::shares_of(std::span<const std::int64_t> nodes) const {
  if (asked_.divide(nodes)) {
    for (int rank = 1; rank < world_.size(); ++rank)
      world_.send(rank, order(Order::nodes).put_all(asked_.shares()[rank].nodes).bytes());
  }
  return asked_.shares();
}

void FluidOnRanks::velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const {
  check_size("velocity()", velocity.size(), 3 * nodes.size());
  const auto& shares = shares_of(nodes);
  tell_others(world_, order(Order::velocity).bytes());
  std::vector<double> own(3 * shares[0].nodes.size());
  own_->velocity(shares[0].nodes, own);
  place(own, 3, shares[0], velocity);
  for (int rank = 1; rank < world_.size(); ++rank) place(answer_of(rank), 3, shares[rank], velocity);
}

void FluidOnRanks::free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                                 std::span<double> mobility) const {
  check_size("free_velocity()", velocity.size(), 3 * nodes.size());
  check_size("free_velocity(): mobility", mobility.size(), nodes.size());
  const auto& shares = shares_of(nodes);
  tell_others(world_, order(Order::free_velocity).bytes());
  const std::size_t n_own = shares[0].nodes.size();
  std::vector<double> own_velocity(3 * n_own), own_mobility(n_own);
  own_->free_velocity(shares[0].nodes, own_velocity, own_mobility);
  place(own_velocity, 3, shares[0], velocity);
  place(own_mobility, 1, shares[0], mobility);
  for (int rank = 1; rank < world_.size(); ++rank) {
    place(answer_of(rank), 3, shares[rank], velocity);
    place(answer_of(rank), 1, shares[rank], mobility);
  }
}

std::vector<double> FluidOnRanks::answer_of(int rank) const {
  return Unpacking(world_.receive(rank)).take_all<double>();
}

void FluidOnRanks::dissipation(std::span<double> power) const {
  check_size("dissipation()", power.size(), static_cast<std::size_t>(shape_.size()));
  tell_others(world_, order(Order::dissipation).bytes());
  gather(power_in(*own_, &fluid::Fluid::dissipation), 1, power);
}

void FluidOnRanks::wall_power(std::span<double> power) const {
  check_size("wall_power()", power.size(), static_cast<std::size_t>(shape_.size()));
  tell_others(world_, order(Order::wall_power).bytes());
  gather(power_in(*own_, &fluid::Fluid::wall_power), 1, power);
}

void FluidOnRanks::moments(std::span<double> density, std::span<double> velocity) const {
  moments_of_layers({0, shape_.nz}, density, velocity);
}

void FluidOnRanks::moments_of_layers(fluid::Layers layers, std::span<double> density,
                                     std::span<double> velocity) const {
  const auto n = static_cast<std::size_t>(std::int64_t{layers.end - layers.begin} * shape_.nx * shape_.ny);
  check_size("moments(): density", density.size(), n);
  check_size("moments(): velocity", velocity.size(), 3 * n);
  tell_others(world_, order(Order::moments).put(layers).bytes());
  const auto own = moments_of(*own_, own_layers(layers, division_.block(0)));
  place_layers(own.density, 1, division_, 0, layers, density);
  place_layers(own.velocity, 3, division_, 0, layers, velocity);
  for (int rank = 1; rank < world_.size(); ++rank) {
    place_layers(answer_of(rank), 1, division_, rank, layers, density);
    place_layers(answer_of(rank), 3, division_, rank, layers, velocity);
  }
}

/// Numbers of all nodes: those of this rank's part, and what the others answer.
void FluidOnRanks::gather(std::span<const double> own, int components, std::span<double> of_box) const {
  place_block(own, components, division_, 0, of_box);
  for (int rank = 1; rank < world_.size(); ++rank)
    place_block(answer_of(rank), components, division_, rank, of_box);
}

void FluidOnRanks::add_force(std::span<const std::int64_t> nodes, std::span<const double> force) {
  check_size("add_force()", force.size(), 3 * nodes.size());
  const auto& shares = shares_of(nodes);
  for (int rank = 1; rank < world_.size(); ++rank)
    world_.send(rank, order(Order::add_force).put_all(taken(force, 3, shares[rank])).bytes());
  own_->add_force(shares[0].nodes, taken(force, 3, shares[0]));
}

void FluidOnRanks::clear_force() {
  tell_others(world_, order(Order::clear_force).bytes());
  own_->clear_force();
}

std::span<const double> FluidOnRanks::force() const {
  tell_others(world_, order(Order::force).bytes());
  force_.resize(3 * static_cast<std::size_t>(shape_.size()));
  gather(own_->force(), 3, force_);
  return force_;
}

void FluidOnRanks::set_viscosity(std::span<const double> kinematic_viscosity) {
  check_size("set_viscosity()", kinematic_viscosity.size(), static_cast<std::size_t>(shape_.size()));
  check_viscosity(kinematic_viscosity);
  own_->set_viscosity(block_of(kinematic_viscosity, 1, division_, 0));
  for (int rank = 1; rank < world_.size(); ++rank) {
    world_.send(
        rank,
        order(Order::set_viscosities).put_all(block_of(kinematic_viscosity, 1, division_, rank)).bytes());
  }
}

void FluidOnRanks::set_viscosity(std::span<const std::int64_t> nodes,
                                 std::span<const double> kinematic_viscosity) {
  check_size("set_viscosity()", kinematic_viscosity.size(), nodes.size());
  check_viscosity(kinematic_viscosity);
  changed_.divide(nodes);
  const auto& shares = changed_.shares();
  own_->set_viscosity(shares[0].nodes, taken(kinematic_viscosity, 1, shares[0]));
  for (int rank = 1; rank < world_.size(); ++rank) {
    if (shares[rank].nodes.empty()) continue;
    world_.send(rank, order(Order::set_viscosity_of)
                          .put_all(shares[rank].nodes)
                          .put_all(taken(kinematic_viscosity, 1, shares[rank]))
                          .bytes());
  }
}

double FluidOnRanks::step() {
  tell_others(world_, order(Order::step).bytes());
  auto first = step_of(*own_);
  double highest = first.highest_speed;
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking message(world_.receive(rank));
    auto answer = take_step_answer(message);
    highest = std::max(highest, answer.highest_speed);
    if (answer.broke_down && (!first.broke_down || answer.node < first.node)) first = std::move(answer);
  }
  if (first.broke_down) throw fluid::Breakdown(first.message, first.node);
  return highest;
}

/// Takes a part's numbers of an array to that of the box, which has nodes without any where a part lacks it.
void FluidOnRanks::add_part(const fluid::State& part, int rank, fluid::State& state) const {
  for (const auto& array : part.arrays) {
    const auto same = [&](const fluid::StateArray& other) { return other.name == array.name; };
    auto place_of_array = std::ranges::find_if(state.arrays, same);
    if (place_of_array == state.arrays.end()) {
      // The viscosity, which a part has once one of its nodes has another than that of the settings.
      std::vector<double> values(array.components * static_cast<std::size_t>(shape_.size()), base_viscosity_);
      state.arrays.push_back({array.name, array.components, std::move(values)});
      place_of_array = state.arrays.end() - 1;
    }
    place_block(array.values, array.components, division_, rank, place_of_array->values);
  }
}

fluid::State FluidOnRanks::state() const {
  tell_others(world_, order(Order::state).bytes());
  fluid::State state;
  {
    const fluid::State own = own_->state();
    state.step = own.step;
    add_part(own, 0, state);
  }
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking message(world_.receive(rank));
    add_part(take_state(message), rank, state);
  }
  return state;
}

void FluidOnRanks::restore(const fluid::State& state) {
  for (const auto& array : state.arrays) {
    if (array.name == "viscosity") check_viscosity(array.values);
    check_size(("state array '" + array.name + "'").c_str(), array.values.size(),
               array.components * static_cast<std::size_t>(shape_.size()));
  }
  for (int rank = 0; rank < world_.size(); ++rank) {  // its own first: what it refuses goes no further
    fluid::State part{state.step, {}};
    for (const auto& array : state.arrays)
      part.arrays.push_back(
          {array.name, array.components, block_of(array.values, array.components, division_, rank)});
    if (rank == 0) {
      own_->restore(part);
      continue;
    }
    auto message = order(Order::restore);
    pack(message, part);
    world_.send(rank, message.bytes());
  }
}

void FluidOnRanks::restore_pieces(const std::filesystem::path& index) {
  tell_others(world_, order(Order::restore_pieces).put_text(index.string()).bytes());
  auto first = restore_part(world_, *own_, division_, index);
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking message(world_.receive(rank));
    auto answer = take_restore_answer(message);
    if (first.error.empty()) first = std::move(answer);
  }
  if (first.error.empty()) return;
  if (first.is_of_files) throw exchange::FileError(first.error);
  throw std::invalid_argument(first.error);
}

}  // namespace tanktread::driver
