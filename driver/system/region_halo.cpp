#include "driver/system/region_halo.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "ranks/packing.hpp"

namespace tanktread::driver {

RegionHalo::RegionHalo(const ranks::World& world, const ranks::Division& division,
                       const coupler::GridPart& region)
    : world_(world),
      places_(division),
      region_(region),
      wanted_(static_cast<std::size_t>(division.n_ranks())),
      wanted_places_(wanted_.size()) {
  for (int rank = 0; rank < division.n_ranks(); ++rank) blocks_.push_back(division.block(rank));
}

void RegionHalo::find(std::span<const std::int64_t> nodes) {
  take_in(nodes);
  std::vector<ranks::Message> requests;
  owners_.clear();
  for (int rank = 0; rank < world_.size(); ++rank) {
    const auto& wanted = wanted_[static_cast<std::size_t>(rank)];
    if (wanted.empty()) continue;
    owners_.push_back(rank);
    requests.push_back({rank, ranks::Packing().put_all(wanted).take_bytes()});
  }
  answer(world_.exchange(std::move(requests)));
}

// Neighbours in the list are mostly neighbours in a row, whose part along y and z is looked up once.
void RegionHalo::take_in(std::span<const std::int64_t> nodes) {
  own_nodes_.clear();
  own_places_.clear();
  for (auto& wanted : wanted_) wanted.clear();
  for (auto& places : wanted_places_) places.clear();
  const std::int64_t nx = region_.nodes[0], ny = region_.nodes[1];
  std::int64_t row_begin = 0, row_end = -1;
  int y = 0, z = 0, part_y = 0, part_z = 0;
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    if (nodes[place] < row_begin || nodes[place] >= row_end) {
      const std::int64_t row = nodes[place] / nx;
      row_begin = row * nx;
      row_end = row_begin + nx;
      y = places_.wrapped(1, region_.begin[1] + static_cast<int>(row % ny));
      z = places_.wrapped(2, region_.begin[2] + static_cast<int>(row / ny));
      part_y = places_.part_of(1, y);
      part_z = places_.part_of(2, z);
    }
    const int x = places_.wrapped(0, region_.begin[0] + static_cast<int>(nodes[place] - row_begin));
    const int rank = places_.rank_of({places_.part_of(0, x), part_y, part_z});
    const auto& block = blocks_[static_cast<std::size_t>(rank)];
    const std::int64_t number =
        (std::int64_t{z - block.begin[2]} * block.n[1] + (y - block.begin[1])) * block.n[0] + x -
        block.begin[0];
    const bool is_own = rank == world_.rank();
    (is_own ? own_nodes_ : wanted_[static_cast<std::size_t>(rank)]).push_back(number);
    (is_own ? own_places_ : wanted_places_[static_cast<std::size_t>(rank)]).push_back(place);
  }
}

void RegionHalo::answer(std::vector<ranks::Message> requests) {
  asked_.clear();
  for (auto& request : requests) {
    const auto nodes = ranks::Unpacking(std::move(request.bytes)).take_all<std::int64_t>();
    Share share{request.rank, {}};
    share.places.reserve(nodes.size());
    std::size_t at = 0;
    for (const std::int64_t node : nodes) {
      // Mostly the next of the list; round a face the order begins again.
      if (at >= own_nodes_.size() || own_nodes_[at] != node)
        at = static_cast<std::size_t>(std::ranges::lower_bound(own_nodes_, node) - own_nodes_.begin());
      if (at == own_nodes_.size() || own_nodes_[at] != node)
        throw std::logic_error("a rank asks for a grid node that no stencil here touches");
      share.places.push_back(own_places_[at++]);
    }
    asked_.push_back(std::move(share));
  }
}

void RegionHalo::place_own(std::span<const double> of_own, int components, std::span<double> of_list) const {
  for (std::size_t k = 0; k < own_places_.size(); ++k)
    std::copy_n(&of_own[components * k], components, &of_list[components * own_places_[k]]);
}

void RegionHalo::take_own(std::span<const double> of_list, int components,
                          std::vector<double>& of_own) const {
  of_own.resize(components * own_places_.size());
  for (std::size_t k = 0; k < own_places_.size(); ++k)
    std::copy_n(&of_list[components * own_places_[k]], components, &of_own[components * k]);
}

void RegionHalo::complete(int components, std::span<double> of_list) const {
  const std::size_t n_bytes = sizeof(double) * static_cast<std::size_t>(components);
  std::vector<ranks::Message> outgoing;
  for (const auto& share : asked_) {
    auto& bytes =
        outgoing
            .emplace_back(ranks::Message{share.rank, std::vector<std::byte>(n_bytes * share.places.size())})
            .bytes;
    std::byte* next = bytes.data();
    for (const std::size_t place : share.places) {
      std::memcpy(next, &of_list[components * place], n_bytes);
      next += n_bytes;
    }
  }
  for (const auto& message : world_.exchange(std::move(outgoing), owners_)) {
    const auto& places = wanted_places_[static_cast<std::size_t>(message.rank)];
    if (message.bytes.size() != n_bytes * places.size())
      throw std::logic_error("a rank answers with other numbers than were asked for");
    const std::byte* next = message.bytes.data();
    for (const std::size_t place : places) {
      std::memcpy(&of_list[components * place], next, n_bytes);
      next += n_bytes;
    }
  }
}

}  // namespace tanktread::driver
