#include "driver/system/region_halo.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "ranks/packing.hpp"

namespace tanktread::driver {
namespace {

/// Adds a place to runs of places. @param Runs of Run
template <class Runs>
void add_place(std::size_t place, Runs& runs) {
  if (!runs.empty() && runs.back().first + runs.back().n == place) {
    ++runs.back().n;
  } else {
    runs.push_back({place, 1});
  }
}

/// Numbers from their places in those of the list to memory without gaps.
template <class Runs>
void take_runs(std::span<const double> of_list, std::size_t components, const Runs& runs, std::byte* to) {
  for (const auto& run : runs) {
    const std::size_t n_bytes = sizeof(double) * components * run.n;
    std::memcpy(to, &of_list[components * run.first], n_bytes);
    to += n_bytes;
  }
}

/// The way back.
template <class Runs>
void place_runs(const std::byte* from, std::size_t components, const Runs& runs, std::span<double> of_list) {
  for (const auto& run : runs) {
    const std::size_t n_bytes = sizeof(double) * components * run.n;
    std::memcpy(&of_list[components * run.first], from, n_bytes);
    from += n_bytes;
  }
}

}  // namespace

void RegionHalo::Nodes::add(std::int64_t node, std::size_t place) {
  nodes.push_back(node);
  add_place(place, runs);
}

RegionHalo::RegionHalo(const ranks::World& world, const ranks::Division& division,
                       const coupler::GridPart& region)
    : world_(world),
      places_(division),
      region_(region),
      wanted_(static_cast<std::size_t>(division.n_ranks())) {
  for (int rank = 0; rank < division.n_ranks(); ++rank) blocks_.push_back(division.block(rank));
}

void RegionHalo::find(std::span<const std::int64_t> nodes) {
  take_in(nodes);
  std::vector<ranks::Message> requests;
  owners_.clear();
  for (int rank = 0; rank < world_.size(); ++rank) {
    const auto& wanted = wanted_[static_cast<std::size_t>(rank)].nodes;
    if (wanted.empty()) continue;
    owners_.push_back(rank);
    requests.push_back({rank, ranks::Packing().put_all(wanted).take_bytes()});
  }
  answer(world_.exchange(std::move(requests)));
}

RegionHalo::Segment RegionHalo::segment_from(std::int64_t node) const {
  const std::int64_t nx = region_.nodes[0], ny = region_.nodes[1], row = node / nx;
  const int x = places_.wrapped(0, region_.begin[0] + static_cast<int>(node - row * nx));
  const int y = places_.wrapped(1, region_.begin[1] + static_cast<int>(row % ny));
  const int z = places_.wrapped(2, region_.begin[2] + static_cast<int>(row / ny));
  const auto rank = static_cast<std::size_t>(
      places_.rank_of({places_.part_of(0, x), places_.part_of(1, y), places_.part_of(2, z)}));
  const auto& block = blocks_[rank];
  const std::int64_t number =
      (std::int64_t{z - block.begin[2]} * block.n[1] + (y - block.begin[1])) * block.n[0] + x -
      block.begin[0];
  const std::int64_t n_in_block = block.begin[0] + block.n[0] - x, n_in_row = (row + 1) * nx - node;
  return {node, node + std::min(n_in_block, n_in_row), rank, number - node};
}

void RegionHalo::take_in(std::span<const std::int64_t> nodes) {
  own_.nodes.clear();
  own_.runs.clear();
  for (auto& wanted : wanted_) {
    wanted.nodes.clear();
    wanted.runs.clear();
  }
  const auto own_rank = static_cast<std::size_t>(world_.rank());
  Segment segment;
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    if (nodes[place] < segment.begin || nodes[place] >= segment.end) segment = segment_from(nodes[place]);
    (segment.rank == own_rank ? own_ : wanted_[segment.rank]).add(nodes[place] + segment.shift, place);
  }
}

void RegionHalo::answer(std::vector<ranks::Message> requests) {
  // Where the own nodes stand in the list, run by run.
  std::vector<std::size_t> places;
  places.reserve(own_.nodes.size());
  for (const auto& run : own_.runs)
    for (std::size_t k = 0; k < run.n; ++k) places.push_back(run.first + k);
  asked_.clear();
  for (auto& request : requests) {
    const auto nodes = ranks::Unpacking(std::move(request.bytes)).take_all<std::int64_t>();
    Asked asked{request.rank, nodes.size(), {}};
    std::size_t at = 0;
    for (const std::int64_t node : nodes) {
      // Mostly the next of the list; round a face the order begins again.
      if (at >= own_.nodes.size() || own_.nodes[at] != node)
        at = static_cast<std::size_t>(std::ranges::lower_bound(own_.nodes, node) - own_.nodes.begin());
      if (at == own_.nodes.size() || own_.nodes[at] != node)
        throw std::logic_error("a rank asks for a grid node that no stencil here touches");
      add_place(places[at++], asked.runs);
    }
    asked_.push_back(std::move(asked));
  }
}

void RegionHalo::place_own(std::span<const double> of_own, int components, std::span<double> of_list) const {
  place_runs(std::as_bytes(of_own).data(), static_cast<std::size_t>(components), own_.runs, of_list);
}

void RegionHalo::take_own(std::span<const double> of_list, int components,
                          std::vector<double>& of_own) const {
  of_own.resize(components * own_.nodes.size());
  take_runs(of_list, static_cast<std::size_t>(components), own_.runs,
            std::as_writable_bytes(std::span(of_own)).data());
}

void RegionHalo::complete(int components, std::span<double> of_list) const {
  const auto n = static_cast<std::size_t>(components);
  std::vector<ranks::Message> outgoing;
  for (const auto& asked : asked_) {
    ranks::Message message{asked.rank, std::vector<std::byte>(sizeof(double) * n * asked.n_nodes)};
    take_runs(of_list, n, asked.runs, message.bytes.data());
    outgoing.push_back(std::move(message));
  }
  for (const auto& message : world_.exchange(std::move(outgoing), owners_)) {
    const auto& wanted = wanted_[static_cast<std::size_t>(message.rank)];
    if (message.bytes.size() != sizeof(double) * n * wanted.nodes.size())
      throw std::logic_error("a rank answers with other numbers than were asked for");
    place_runs(message.bytes.data(), n, wanted.runs, of_list);
  }
}

}  // namespace tanktread::driver
