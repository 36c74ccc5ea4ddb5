#include "driver/system/node_shares.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tanktread::driver {

std::vector<NodeShare> node_shares(const ranks::Division& division, std::span<const std::int64_t> nodes) {
  const auto& n = division.box().n;
  std::vector<NodeShare> shares(static_cast<std::size_t>(division.n_ranks()));
  std::vector<ranks::Block> blocks;
  for (int rank = 0; rank < division.n_ranks(); ++rank) blocks.push_back(division.block(rank));
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    const std::int64_t node = nodes[place];
    if (node < 0 || node >= std::int64_t{n[0]} * n[1] * n[2])
      throw std::invalid_argument("node " + std::to_string(node) + " is outside the box");
    const std::int64_t row = node / n[0];
    const ranks::Triple at = {static_cast<int>(node % n[0]), static_cast<int>(row % n[1]),
                              static_cast<int>(row / n[1])};
    const auto rank = static_cast<std::size_t>(division.owner(at));
    const auto& block = blocks[rank];
    const fluid::GridShape shape = {block.n[0], block.n[1], block.n[2]};
    shares[rank].nodes.push_back(
        shape.index(at[0] - block.begin[0], at[1] - block.begin[1], at[2] - block.begin[2]));
    shares[rank].places.push_back(place);
  }
  return shares;
}

std::vector<std::int64_t> nodes_of_rank(const ranks::Division& division, int rank) {
  const auto block = division.block(rank);
  const auto& n = division.box().n;
  std::vector<std::int64_t> nodes;
  nodes.reserve(static_cast<std::size_t>(block.n[0]) * block.n[1] * block.n[2]);
  for (int z = block.begin[2]; z < block.begin[2] + block.n[2]; ++z)
    for (int y = block.begin[1]; y < block.begin[1] + block.n[1]; ++y)
      for (int x = block.begin[0]; x < block.begin[0] + block.n[0]; ++x)
        nodes.push_back((std::int64_t{z} * n[1] + y) * n[0] + x);
  return nodes;
}

std::vector<double> taken(std::span<const double> of_list, int components, const NodeShare& share) {
  std::vector<double> of_share(components * share.places.size());
  double* to = of_share.data();
  for (const std::size_t place : share.places) to = std::copy_n(&of_list[components * place], components, to);
  return of_share;
}

void place(std::span<const double> of_share, int components, const NodeShare& share,
           std::span<double> of_list) {
  const double* from = of_share.data();
  for (const std::size_t place : share.places) {
    std::copy_n(from, components, &of_list[components * place]);
    from += components;
  }
}

}  // namespace tanktread::driver
