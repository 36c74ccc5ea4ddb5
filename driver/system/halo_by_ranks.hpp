// The border of a part of the fluid, carried to the ranks beside it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fluid/halo.hpp"
#include "ranks/neighbour_messages.hpp"

namespace tanktread::driver {

/// The part of the fluid that a rank has.
inline fluid::GridPart part_of(const ranks::Division& division, int rank) {
  const auto block = division.block(rank);
  return {block.begin, {block.n[0], block.n[1], block.n[2]}};
}

/// World is borrowed.
class HaloByRanks final : public fluid::HaloExchange {
 public:
  HaloByRanks(const ranks::World& world, const ranks::Division& division)
      : world_(world), division_(division) {}

  void connect(std::span<const fluid::HaloMessage> messages) override {
    std::vector<ranks::NeighbourMessage> to_neighbours;
    for (const auto& message : messages)
      to_neighbours.push_back({message.direction, message.outgoing, message.incoming});
    messages_.emplace(world_, division_, to_neighbours);
  }
  void start() override { messages_->start(); }
  void finish() override { messages_->finish(); }

 private:
  const ranks::World& world_;
  ranks::Division division_;
  std::optional<ranks::NeighbourMessages> messages_;
};

}  // namespace tanktread::driver
