#include "driver/system/capsule_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "driver/system/pack_matrix.hpp"

namespace tanktread::driver {
namespace {

bool contains(const std::vector<int>& ascending, int number) {
  return std::ranges::binary_search(ascending, number);
}

/// A message to each of the ranks, written by one after the other.
class Letters {
 public:
  explicit Letters(const std::vector<int>& ranks) : ranks_(ranks), packings_(ranks.size()) {}

  ranks::Packing& to(int rank) {
    return packings_[static_cast<std::size_t>(std::ranges::lower_bound(ranks_, rank) - ranks_.begin())];
  }
  std::vector<ranks::Message> take() {
    std::vector<ranks::Message> messages;
    for (std::size_t k = 0; k < ranks_.size(); ++k)
      messages.push_back({ranks_[k], packings_[k].take_bytes()});
    return messages;
  }

 private:
  const std::vector<int>& ranks_;  // ascending
  std::vector<ranks::Packing> packings_;
};

}  // namespace

CapsuleMessages::CapsuleMessages(const ranks::World& world, const ranks::Division& division, int reach)
    : world_(world), places_(division), reach_(reach) {}

void CapsuleMessages::forget() {
  know_triangles_.clear();
  triangles_.clear();
}

// As far as there are nodes within the reach of a coordinate; of a length that is not finite none.
std::vector<int> CapsuleMessages::parts_near(int axis, double lowest, double highest) const {
  std::vector<int> parts;
  const int n = places_.n_nodes()[axis];
  if (!std::isfinite(lowest) || !std::isfinite(highest)) return parts;
  const bool is_everywhere = highest - lowest + 2 * reach_ + 2 >= n;
  if (is_everywhere) {
    for (int part = 0; part < places_.n_parts(axis); ++part) parts.push_back(part);
    return parts;
  }
  const double period = std::floor(lowest / n) * n;  // so that numbers fit an int, however far it has gone
  const bool wraps = places_.is_periodic(axis);
  const int first = static_cast<int>(std::floor(lowest - (wraps ? period : 0))) - reach_;
  const int last = static_cast<int>(std::floor(highest - (wraps ? period : 0))) + reach_;
  for (int node = first; node <= last; ++node) {
    if (!wraps && (node < 0 || node >= n)) continue;
    const int part = places_.part_of(axis, node);
    if (parts.empty() || parts.back() != part) parts.push_back(part);
  }
  std::ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

std::vector<int> CapsuleMessages::ranks_near(const Eigen::Matrix3Xd& positions) const {
  std::array<std::vector<int>, 3> parts;
  for (int axis = 0; axis < 3; ++axis)
    parts[axis] = parts_near(axis, positions.row(axis).minCoeff(), positions.row(axis).maxCoeff());
  std::vector<int> near;
  for (const int z : parts[2])
    for (const int y : parts[1])
      for (const int x : parts[0]) near.push_back(places_.rank_of({x, y, z}));
  return near;  // ascending, for ranks count along x first
}

void CapsuleMessages::send_surfaces(const OwnCapsules& own, NearCapsules& near) {
  know_triangles_.resize(own.numbers.size());
  near_ranks_.clear();
  partners_.clear();
  own_numbers_ = own.numbers;
  for (const auto& positions : own.positions) {
    near_ranks_.push_back(ranks_near(positions));
    partners_.insert(partners_.end(), near_ranks_.back().begin(), near_ranks_.back().end());
  }
  std::ranges::sort(partners_);
  partners_.erase(std::unique(partners_.begin(), partners_.end()), partners_.end());

  Letters letters(partners_);
  for (std::size_t k = 0; k < own.numbers.size(); ++k) {
    auto& know = know_triangles_[k];
    for (const int rank : near_ranks_[k]) {
      const bool knows = contains(know, rank);
      letters.to(rank).put(true).put(own.numbers[k]).put(!knows);
      if (!knows) {
        pack_matrix(letters.to(rank), own.triangles[k]);
        know.insert(std::ranges::lower_bound(know, rank), rank);
      }
      pack_matrix(letters.to(rank), own.positions[k]);
      pack_matrix(letters.to(rank), own.force[k]);
    }
  }
  for (const int rank : partners_) letters.to(rank).put(false);

  const std::size_t n_capsules = near.surfaces.positions.size();
  triangles_.resize(n_capsules);
  std::vector<char> is_near(n_capsules, 0);
  origins_.clear();
  owners_.clear();
  for (auto& message : world_.exchange(letters.take())) {
    Origin origin{message.rank, {}};
    ranks::Unpacking letter(std::move(message.bytes));
    while (letter.take<bool>()) {
      const auto number = letter.take<std::size_t>();
      if (letter.take<bool>()) take_matrix(letter, triangles_[number]);
      if (near.surfaces.triangles[number].cols() == 0) near.surfaces.triangles[number] = triangles_[number];
      take_matrix(letter, near.surfaces.positions[number]);
      take_matrix(letter, near.force[number]);
      near.velocity[number].resize(3, near.force[number].cols());
      is_near[number] = 1;
      origin.numbers.push_back(number);
    }
    owners_.push_back(origin.owner);
    origins_.push_back(std::move(origin));
  }
  for (std::size_t number = 0; number < n_capsules; ++number) {
    if (is_near[number] || near.surfaces.positions[number].cols() == 0) continue;
    near.surfaces.triangles[number].resize(3, 0);
    for (auto* vectors : {&near.surfaces.positions, &near.force, &near.velocity})
      (*vectors)[number].resize(3, 0);
  }
}

void CapsuleMessages::send_forces(const NodeVectors& own, NodeVectors& near) const {
  Letters letters(partners_);
  for (std::size_t k = 0; k < own.size(); ++k)
    for (const int rank : near_ranks_[k]) pack_matrix(letters.to(rank), own[k]);
  auto messages = world_.exchange(letters.take(), owners_);
  for (std::size_t k = 0; k < messages.size(); ++k) {
    ranks::Unpacking letter(std::move(messages[k].bytes));
    for (const std::size_t number : origins_[k].numbers) take_matrix(letter, near[number]);
  }
}

void CapsuleMessages::bring_velocities(const NodeVectors& near,
                                       std::span<const std::span<const std::int32_t>> home,
                                       NodeVectors& own) const {
  Letters letters(owners_);
  for (const auto& origin : origins_) {
    for (const std::size_t number : origin.numbers) {
      const auto nodes = home[number];
      auto& letter = letters.to(origin.owner);
      letter.put_all(nodes);
      std::vector<double> velocity;
      velocity.reserve(3 * nodes.size());
      for (const std::int32_t node : nodes) {
        const auto of_node = near[number].col(node);
        velocity.insert(velocity.end(), {of_node[0], of_node[1], of_node[2]});
      }
      letter.put_all(velocity);
    }
  }
  std::vector<Eigen::Index> n_found(own.size(), 0);
  for (auto& message : world_.exchange(letters.take(), partners_)) {
    ranks::Unpacking letter(std::move(message.bytes));
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!contains(near_ranks_[k], message.rank)) continue;
      const auto nodes = letter.take_all<std::int32_t>();
      const auto velocity = letter.take_all<double>();
      for (std::size_t j = 0; j < nodes.size(); ++j)
        own[k].col(nodes[j]) = Eigen::Vector3d::Map(&velocity[3 * j]);
      n_found[k] += static_cast<Eigen::Index>(nodes.size());
    }
  }
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (n_found[k] != own[k].cols())
      throw std::logic_error("capsule " + std::to_string(own_numbers_[k]) +
                             ": not every node is at home at one rank");
  }
}

}  // namespace tanktread::driver
