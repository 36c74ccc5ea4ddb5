#include "driver/system/fluid_on_ranks.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "driver/system/part_orders.hpp"

namespace tanktread::driver {
namespace {

using ranks::Packing;
using ranks::Unpacking;

Packing order(Order which) {
  Packing packing;
  packing.put(which);
  return packing;
}

void check_size(const char* what, std::size_t size, std::size_t needed) {
  if (size == needed) return;
  throw std::invalid_argument(std::string("fluid on ranks: ") + what + " has room for " +
                              std::to_string(size) + " numbers, " + std::to_string(needed) + " are needed");
}

}  // namespace

FluidOnRanks::FluidOnRanks(const ranks::World& world, const ranks::Division& division,
                           const fluid::LatticeBoltzmannSettings& settings)
    : world_(world),
      division_(division),
      shape_(settings.shape),
      base_viscosity_(fluid::viscosity_of(settings)) {
  auto message = order(Order::make_part);
  message.put(division.box()).put(division.parts()).put(settings);
  tell_all(message.bytes());
  own_ = make_part(world, division, settings);
}

FluidOnRanks::~FluidOnRanks() {
  auto message = order(Order::give_up_part);
  message.put(broken_);
  tell_all(message.bytes());
  end_exchange(*own_, broken_);
}

void FluidOnRanks::tell_all(std::span<const std::byte> message) const {
  for (int rank = 1; rank < world_.size(); ++rank) world_.send(rank, message);
}

void FluidOnRanks::velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const {
  check_size("velocity()", velocity.size(), 3 * nodes.size());
  const auto shares = node_shares(division_, nodes);
  for (int rank = 1; rank < world_.size(); ++rank)
    world_.send(rank, order(Order::velocity).put_all(shares[rank].nodes).bytes());
  std::vector<double> own(3 * shares[0].nodes.size());
  own_->velocity(shares[0].nodes, own);
  place(own, 3, shares[0], velocity);
  for (int rank = 1; rank < world_.size(); ++rank)
    place(Unpacking(world_.receive(rank)).take_all<double>(), 3, shares[rank], velocity);
}

void FluidOnRanks::free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                                 std::span<double> mobility) const {
  check_size("free_velocity()", velocity.size(), 3 * nodes.size());
  check_size("free_velocity(): mobility", mobility.size(), nodes.size());
  const auto shares = node_shares(division_, nodes);
  for (int rank = 1; rank < world_.size(); ++rank)
    world_.send(rank, order(Order::free_velocity).put_all(shares[rank].nodes).bytes());
  const std::size_t n_own = shares[0].nodes.size();
  std::vector<double> own_velocity(3 * n_own), own_mobility(n_own);
  own_->free_velocity(shares[0].nodes, own_velocity, own_mobility);
  place(own_velocity, 3, shares[0], velocity);
  place(own_mobility, 1, shares[0], mobility);
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking answer(world_.receive(rank));
    place(answer.take_all<double>(), 3, shares[rank], velocity);
    place(answer.take_all<double>(), 1, shares[rank], mobility);
  }
}

/// Puts numbers of all nodes together, one part after the other.
/// @param own the numbers of this rank's part @param ask the same of the message of another rank
template <class Own, class OfPart>
void FluidOnRanks::gather(int components, std::span<double> of_box, Own own, OfPart ask) const {
  for (int rank = 0; rank < world_.size(); ++rank) {
    const std::vector<double> numbers = rank == 0 ? own() : ask(rank);
    const auto nodes = nodes_of_rank(division_, rank);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      std::copy_n(&numbers[components * k], components, &of_box[components * nodes[k]]);
  }
}

void FluidOnRanks::dissipation(std::span<double> power) const {
  check_size("dissipation()", power.size(), static_cast<std::size_t>(shape_.size()));
  tell_all(order(Order::dissipation).bytes());
  std::vector<double> own(static_cast<std::size_t>(own_->shape().size()));
  own_->dissipation(own);
  gather(
      1, power, [&] { return own; },
      [&](int rank) { return Unpacking(world_.receive(rank)).take_all<double>(); });
}

void FluidOnRanks::wall_power(std::span<double> power) const {
  check_size("wall_power()", power.size(), static_cast<std::size_t>(shape_.size()));
  tell_all(order(Order::wall_power).bytes());
  std::vector<double> own(static_cast<std::size_t>(own_->shape().size()));
  own_->wall_power(own);
  gather(
      1, power, [&] { return own; },
      [&](int rank) { return Unpacking(world_.receive(rank)).take_all<double>(); });
}

void FluidOnRanks::moments(std::span<double> density, std::span<double> velocity) const {
  check_size("moments(): density", density.size(), static_cast<std::size_t>(shape_.size()));
  check_size("moments(): velocity", velocity.size(), 3 * static_cast<std::size_t>(shape_.size()));
  tell_all(order(Order::moments).bytes());
  const auto n = static_cast<std::size_t>(own_->shape().size());
  std::vector<double> own_density(n), own_velocity(3 * n);
  own_->moments(own_density, own_velocity);
  std::vector<std::vector<double>> velocities(static_cast<std::size_t>(world_.size()));
  velocities[0] = std::move(own_velocity);
  gather(
      1, density, [&] { return own_density; },
      [&](int rank) {
        Unpacking answer(world_.receive(rank));
        auto of_part = answer.take_all<double>();
        velocities[rank] = answer.take_all<double>();
        return of_part;
      });
  const auto at = [&](int rank) { return std::move(velocities[rank]); };
  gather(
      3, velocity, [&] { return at(0); }, at);
}

void FluidOnRanks::add_force(std::span<const std::int64_t> nodes, std::span<const double> force) {
  check_size("add_force()", force.size(), 3 * nodes.size());
  const auto shares = node_shares(division_, nodes);
  for (int rank = 1; rank < world_.size(); ++rank) {
    world_.send(
        rank,
        order(Order::add_force).put_all(shares[rank].nodes).put_all(taken(force, 3, shares[rank])).bytes());
  }
  own_->add_force(shares[0].nodes, taken(force, 3, shares[0]));
}

void FluidOnRanks::clear_force() {
  tell_all(order(Order::clear_force).bytes());
  own_->clear_force();
}

std::span<const double> FluidOnRanks::force() const {
  tell_all(order(Order::force).bytes());
  force_.resize(3 * static_cast<std::size_t>(shape_.size()));
  gather(
      3, force_, [&] { return std::vector<double>(own_->force().begin(), own_->force().end()); },
      [&](int rank) { return Unpacking(world_.receive(rank)).take_all<double>(); });
  return force_;
}

void FluidOnRanks::set_viscosity(std::span<const double> kinematic_viscosity) {
  check_size("set_viscosity()", kinematic_viscosity.size(), static_cast<std::size_t>(shape_.size()));
  for (int rank = 0; rank < world_.size(); ++rank) {
    std::vector<double> of_part;
    for (const std::int64_t node : nodes_of_rank(division_, rank))
      of_part.push_back(kinematic_viscosity[node]);
    if (rank > 0) {
      world_.send(rank, order(Order::set_viscosities).put_all(of_part).bytes());
    } else {
      own_->set_viscosity(of_part);
    }
  }
}

void FluidOnRanks::set_viscosity(std::span<const std::int64_t> nodes,
                                 std::span<const double> kinematic_viscosity) {
  check_size("set_viscosity()", kinematic_viscosity.size(), nodes.size());
  const auto shares = node_shares(division_, nodes);
  for (int rank = 1; rank < world_.size(); ++rank) {
    if (shares[rank].nodes.empty()) continue;
    world_.send(rank, order(Order::set_viscosity_of)
                          .put_all(shares[rank].nodes)
                          .put_all(taken(kinematic_viscosity, 1, shares[rank]))
                          .bytes());
  }
  own_->set_viscosity(shares[0].nodes, taken(kinematic_viscosity, 1, shares[0]));
}

double FluidOnRanks::step() {
  tell_all(order(Order::step).bytes());
  auto first = step_of(*own_);
  double highest = first.highest_speed;
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking message(world_.receive(rank));
    auto answer = take_step_answer(message);
    highest = std::max(highest, answer.highest_speed);
    if (answer.broke_down && (!first.broke_down || answer.node < first.node)) first = std::move(answer);
  }
  if (first.broke_down) {
    broken_ = true;
    throw fluid::Breakdown(first.message, first.node);
  }
  return highest;
}

fluid::State FluidOnRanks::state() const {
  tell_all(order(Order::state).bytes());
  fluid::State state = own_->state();
  std::vector<fluid::State> parts = {state};
  for (int rank = 1; rank < world_.size(); ++rank) {
    Unpacking message(world_.receive(rank));
    parts.push_back(take_state(message));
  }
  // A part may have an array that others have not: a viscosity, once one of its nodes has another.
  for (const auto& part : parts) {
    for (const auto& array : part.arrays) {
      const auto same = [&](const fluid::StateArray& other) { return other.name == array.name; };
      if (std::ranges::none_of(state.arrays, same))
        state.arrays.push_back({array.name, array.components, {}});
    }
  }
  for (auto& array : state.arrays) {
    const auto of = [&](int rank) {
      for (auto& other : parts[rank].arrays)
        if (other.name == array.name) return std::move(other.values);
      const auto n = static_cast<std::size_t>(part_of(division_, rank).shape.size());
      return std::vector<double>(n, base_viscosity_);
    };
    array.values.resize(array.components * static_cast<std::size_t>(shape_.size()));
    gather(
        array.components, array.values, [&] { return of(0); }, of);
  }
  return state;
}

void FluidOnRanks::restore(const fluid::State& state) {
  for (int rank = 0; rank < world_.size(); ++rank) {  // its own first: what it refuses goes no further
    const auto nodes = nodes_of_rank(division_, rank);
    fluid::State part{state.step, {}};
    for (const auto& array : state.arrays) {
      check_size(("state array '" + array.name + "'").c_str(), array.values.size(),
                 array.components * static_cast<std::size_t>(shape_.size()));
      auto& own = part.arrays.emplace_back(array.name, array.components, std::vector<double>());
      own.values.resize(array.components * nodes.size());
      for (std::size_t k = 0; k < nodes.size(); ++k)
        std::copy_n(&array.values[array.components * nodes[k]], array.components,
                    &own.values[array.components * k]);
    }
    if (rank > 0) {
      auto message = order(Order::restore);
      pack(message, part);
      world_.send(rank, message.bytes());
    } else {
      own_->restore(part);
    }
  }
}

}  // namespace tanktread::driver
