#include "driver/system/piece_nodes.hpp"

#include <algorithm>

#include "fluid/layer_ranges.hpp"

namespace tanktread::driver {
namespace {

using exchange::GridBlock;

/// The nodes of a range that a rank's piece is to have: its own, and the layer beyond. Without any: 0 nodes.
coupler::GridPart region_of(const ranks::Division& division, int rank, const Ranges3& range) {
  const auto block = division.block(rank);
  coupler::GridPart region{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int first = std::max(block.begin[axis], range[axis][0]);
    const int last = std::min(block.begin[axis] + block.n[axis] - 1, range[axis][1]);
    if (last < first) return {};
    region.begin[axis] = first;
    region.nodes[axis] = last - first + 1 + (last < range[axis][1] ? 1 : 0);
  }
  return region;
}

}  // namespace

std::optional<GridBlock> piece_of(const ranks::Division& division, int rank, const Ranges3& range) {
  const auto region = region_of(division, rank, range);
  GridBlock piece;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_sheet = range[axis][0] == range[axis][1];
    if (region.nodes[axis] < (is_sheet ? 1 : 2)) return std::nullopt;
    piece.begin[axis] = region.begin[axis] - range[axis][0];
    piece.nodes[axis] = region.nodes[axis];
  }
  return piece;
}

PieceNodes::PieceNodes(const ranks::World* world, const ranks::Division& division, const Ranges3& range)
    : block_(division.block(world != nullptr ? world->rank() : 0)),
      region_(region_of(division, world != nullptr ? world->rank() : 0, range)) {
  if (world == nullptr) return;
  find_border(range);
  std::vector<std::int64_t> nodes;
  for (const auto& node : border_) nodes.push_back(node.in_region);
  halo_.emplace(*world, division, region_);
  halo_->find(nodes);
}

/// Neighbours ask for the first layers of a block where the range begins before it, and it asks for those of
/// others.
void PieceNodes::find_border(const Ranges3& range) {
  std::array<bool, 3> is_asked{};
  for (std::size_t axis = 0; axis < 3; ++axis) is_asked[axis] = block_.begin[axis] > range[axis][0];
  std::int64_t in_region = 0;
  for (int z = region_.begin[2]; z < region_.begin[2] + region_.nodes[2]; ++z) {
    for (int y = region_.begin[1]; y < region_.begin[1] + region_.nodes[1]; ++y) {
      for (int x = region_.begin[0]; x < region_.begin[0] + region_.nodes[0]; ++x, ++in_region) {
        const ranks::Triple place = {x - block_.begin[0], y - block_.begin[1], z - block_.begin[2]};
        bool is_own = true, is_first = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          is_own = is_own && place[axis] < block_.n[axis];
          is_first = is_first || (is_asked[axis] && place[axis] == 0);
        }
        const auto in_block = (std::int64_t{place[2]} * block_.n[1] + place[1]) * block_.n[0] + place[0];
        if (!is_own || is_first) border_.push_back({is_own ? in_block : -1, in_region});
      }
    }
  }
}

/// Of the border nodes, in their order, the others' too.
std::vector<double> PieceNodes::border_numbers(const NodeNumbers& numbers) const {
  const auto components = static_cast<std::size_t>(numbers.components);
  const std::int64_t n_a_layer = std::int64_t{block_.n[0]} * block_.n[1];
  std::vector<double> result(components * border_.size()), of_layers;
  std::size_t next = 0;  // own nodes ascend in the block as they do in the region
  const auto skip_others = [&] {
    while (next < border_.size() && border_[next].in_block < 0) ++next;
  };
  fluid::for_layer_ranges(n_a_layer, block_.n[2], numbers.components, [&](fluid::Layers layers) {
    skip_others();
    if (next == border_.size() || border_[next].in_block >= n_a_layer * layers.end) return;
    layers.begin = static_cast<int>(border_[next].in_block / n_a_layer);
    of_layers.resize(components * static_cast<std::size_t>(n_a_layer * (layers.end - layers.begin)));
    numbers.of_layers(layers, of_layers);
    for (; next < border_.size() && border_[next].in_block < n_a_layer * layers.end; ++next, skip_others()) {
      const auto from = static_cast<std::size_t>(border_[next].in_block - n_a_layer * layers.begin);
      std::copy_n(&of_layers[components * from], components, &result[components * next]);
    }
  });
  if (halo_) halo_->complete(numbers.components, result);
  return result;
}

/// Of a range of layers of the region what this rank has.
void PieceNodes::put_own(const NodeNumbers& numbers, fluid::Layers of_region,
                         std::span<double> values) const {
  const auto components = static_cast<std::size_t>(numbers.components);
  const int shift = region_.begin[2] - block_.begin[2];
  const fluid::Layers layers = {of_region.begin + shift, std::min(of_region.end + shift, block_.n[2])};
  if (layers.end <= layers.begin) return;
  const std::size_t nx = static_cast<std::size_t>(block_.n[0]), ny = static_cast<std::size_t>(block_.n[1]);
  std::vector<double> of_block(components * nx * ny * static_cast<std::size_t>(layers.end - layers.begin));
  numbers.of_layers(layers, of_block);
  const int n_x = std::min(region_.nodes[0], block_.begin[0] + block_.n[0] - region_.begin[0]);
  const int n_y = std::min(region_.nodes[1], block_.begin[1] + block_.n[1] - region_.begin[1]);
  const auto first_x = static_cast<std::size_t>(region_.begin[0] - block_.begin[0]);
  const auto first_y = static_cast<std::size_t>(region_.begin[1] - block_.begin[1]);
  for (int z = 0; z < layers.end - layers.begin; ++z) {
    for (int y = 0; y < n_y; ++y) {
      const auto from =
          (static_cast<std::size_t>(z) * ny + first_y + static_cast<std::size_t>(y)) * nx + first_x;
      const auto to = (static_cast<std::size_t>(z) * static_cast<std::size_t>(region_.nodes[1]) +
                       static_cast<std::size_t>(y)) *
                      static_cast<std::size_t>(region_.nodes[0]);
      std::copy_n(&of_block[components * from], components * static_cast<std::size_t>(n_x),
                  &values[components * to]);
    }
  }
}

void PieceNodes::for_layers(const NodeNumbers& numbers,
                            const std::function<void(std::span<const double>)>& take) const {
  const auto components = static_cast<std::size_t>(numbers.components);
  const auto of_border = border_numbers(numbers);
  const std::int64_t n_a_layer = std::int64_t{region_.nodes[0]} * region_.nodes[1];
  if (n_a_layer == 0) return;
  std::size_t next = 0;
  std::vector<double> values;
  fluid::for_layer_ranges(n_a_layer, region_.nodes[2], numbers.components, [&](fluid::Layers layers) {
    values.resize(components * static_cast<std::size_t>(n_a_layer * (layers.end - layers.begin)));
    put_own(numbers, layers, values);
    for (; next < border_.size() && border_[next].in_region < n_a_layer * layers.end; ++next) {
      const auto to = static_cast<std::size_t>(border_[next].in_region - n_a_layer * layers.begin);
      std::copy_n(&of_border[components * next], components, &values[components * to]);
    }
    take(values);
  });
}

}  // namespace tanktread::driver
