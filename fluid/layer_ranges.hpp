// A box walked through in ranges of layers, so that of an array only a little is in memory.
#pragma once

#include <algorithm>
#include <cstdint>

#include "fluid/state.hpp"

namespace tanktread::fluid {

/// Calls with one Layers after the other: together all layers of a box, each range of about 4 MiB of an array
/// of doubles, one layer at least.
/// @param nodes_a_layer nx ny @param components numbers a node
template <typename Body>
void for_layer_ranges(std::int64_t nodes_a_layer, int n_layers, int components, const Body& body) {
  constexpr std::int64_t n_numbers = (std::int64_t{4} << 20) / static_cast<std::int64_t>(sizeof(double));
  const auto at_a_time = static_cast<int>(
      std::clamp<std::int64_t>(n_numbers / (nodes_a_layer * components), 1, std::max(n_layers, 1)));
  for (int z = 0; z < n_layers; z += at_a_time) body(Layers{z, std::min(z + at_a_time, n_layers)});
}

}  // namespace tanktread::fluid
