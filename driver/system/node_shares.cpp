#include "driver/system/node_shares.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tanktread::driver {
namespace {

/// Calls body(first node of the box, number) for each row of a block.
template <class Body>
void for_each_row(const ranks::Division& division, int rank, const Body& body) {
  const auto block = division.block(rank);
  const auto& n = division.box().n;
  for (int z = block.begin[2]; z < block.begin[2] + block.n[2]; ++z)
    for (int y = block.begin[1]; y < block.begin[1] + block.n[1]; ++y)
      body((std::int64_t{z} * n[1] + y) * n[0] + block.begin[0], block.n[0]);
}

std::size_t numbers_in(const ranks::Division& division, int rank, int components) {
  const auto& n = division.block(rank).n;
  return static_cast<std::size_t>(components) * n[0] * n[1] * n[2];
}

}  // namespace

NodeShares::NodeShares(const ranks::Division& division)
    : shape_{division.box().n[0], division.box().n[1], division.box().n[2]},
      part_places_(division),
      shares_(static_cast<std::size_t>(division.n_ranks())) {
  for (int rank = 0; rank < division.n_ranks(); ++rank) blocks_.push_back(division.block(rank));
}

bool NodeShares::divide(std::span<const std::int64_t> nodes) {
  if (std::ranges::equal(nodes, nodes_)) return false;
  for (const std::int64_t node : nodes) {
    if (node < 0 || node >= shape_.size())
      throw std::invalid_argument("node " + std::to_string(node) + " is outside the box");
  }
  nodes_.assign(nodes.begin(), nodes.end());
  for (auto& share : shares_) {
    share.nodes.clear();
    share.places.clear();
  }
  // Neighbours in a list are mostly neighbours in a row, whose place is looked up once.
  std::int64_t row_begin = 0, row_end = -1;
  int y = 0, z = 0, first_of_row = 0;
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const std::int64_t node = nodes[at];
    if (node < row_begin || node >= row_end) {
      const std::int64_t row = node / shape_.nx;
      row_begin = row * shape_.nx;
      row_end = row_begin + shape_.nx;
      y = static_cast<int>(row % shape_.ny);
      z = static_cast<int>(row / shape_.ny);
      first_of_row = part_places_.rank_of({0, part_places_.part_of(1, y), part_places_.part_of(2, z)});
    }
    const auto x = static_cast<int>(node - row_begin);
    const int rank = first_of_row + part_places_.part_of(0, x);
    const auto& [begin, n] = blocks_[rank];
    shares_[rank].nodes.push_back((std::int64_t{z - begin[2]} * n[1] + (y - begin[1])) * n[0] +
                                  (x - begin[0]));
    shares_[rank].places.push_back(at);
  }
  return true;
}

std::vector<double> taken(std::span<const double> of_list, int components, const NodeShare& share) {
  std::vector<double> of_share(components * share.places.size());
  double* to = of_share.data();
  for (const std::size_t at : share.places) to = std::copy_n(&of_list[components * at], components, to);
  return of_share;
}

void place(std::span<const double> of_share, int components, const NodeShare& share,
           std::span<double> of_list) {
  const double* from = of_share.data();
  for (const std::size_t at : share.places) {
    std::copy_n(from, components, &of_list[components * at]);
    from += components;
  }
}

std::vector<double> block_of(std::span<const double> of_box, int components, const ranks::Division& division,
                             int rank) {
  std::vector<double> of_block(numbers_in(division, rank, components));
  double* to = of_block.data();
  for_each_row(division, rank, [&](std::int64_t node, int n) {
    to = std::copy_n(&of_box[components * node], components * n, to);
  });
  return of_block;
}

void place_block(std::span<const double> of_block, int components, const ranks::Division& division, int rank,
                 std::span<double> of_box) {
  if (of_block.size() != numbers_in(division, rank, components))
    throw std::logic_error("a rank gave another number of values than its part has nodes");
  const double* from = of_block.data();
  for_each_row(division, rank, [&](std::int64_t node, int n) {
    std::copy_n(from, components * n, &of_box[components * node]);
    from += components * n;
  });
}

}  // namespace tanktread::driver
