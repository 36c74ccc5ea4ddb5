// A grid in parts: how it is divided, and which of its nodes a part has.
#pragma once

#include <vector>

#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::test {

/// Along each axis as many parts, of about as many nodes.
inline std::vector<GridPart> parts_of(const Grid& grid, const std::array<int, 3>& division) {
  std::vector<GridPart> parts;
  for (int part = 0; part < division[0] * division[1] * division[2]; ++part) {
    const std::array<int, 3> place = {part % division[0], part / division[0] % division[1],
                                      part / (division[0] * division[1])};
    GridPart result;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cut = [&](int number) { return grid.nodes[axis] * number / division[axis]; };
      result.begin[axis] = cut(place[axis]);
      result.nodes[axis] = cut(place[axis] + 1) - cut(place[axis]);
    }
    parts.push_back(result);
  }
  return parts;
}

/// The divisions of a grid that are tested; all axes are cut, some in thin slices, one unevenly.
inline const std::vector<std::array<int, 3>> divisions = {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {2, 2, 2},
                                                          {3, 1, 2}, {4, 4, 1}, {8, 1, 1}, {1, 6, 5}};

/// Periodic along all axes, and with walls across each.
inline std::vector<Grid> grids_of(const std::array<int, 3>& nodes) {
  return {{nodes, {true, true, true}},
          {nodes, {false, true, true}},
          {nodes, {true, false, true}},
          {nodes, {true, true, false}}};
}

inline std::int64_t count_of(const std::array<int, 3>& nodes) {
  return std::int64_t{1} * nodes[0] * nodes[1] * nodes[2];
}

/// The node of the grid that a node of a block of it is, by linear indices; the block may go round the grid.
inline std::int64_t node_of_grid(const Grid& grid, const GridPart& block, std::int64_t node) {
  auto index = indices_of({block.nodes, grid.periodic}, node);
  for (int axis = 0; axis < 3; ++axis)
    index[axis] = (index[axis] + block.begin[axis] + grid.nodes[axis]) % grid.nodes[axis];
  return (std::int64_t{index[2]} * grid.nodes[1] + index[1]) * grid.nodes[0] + index[0];
}

inline bool has_node(const Grid& grid, const GridPart& part, std::int64_t node) {
  const auto index = indices_of(grid, node);
  for (int axis = 0; axis < 3; ++axis) {
    if (index[axis] < part.begin[axis] || index[axis] >= part.begin[axis] + part.nodes[axis]) return false;
  }
  return true;
}

}  // namespace tanktread::coupler::test
