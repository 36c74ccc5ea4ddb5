#include "coupler/grid_region.hpp"

#include <algorithm>

namespace tanktread::coupler {

void require_part(const Grid& grid, const GridPart& part) {
  for (int axis = 0; axis < 3; ++axis) {
    const int begin = part.begin[axis], nodes = part.nodes[axis];
    if (begin >= 0 && nodes > 0 && nodes <= grid.nodes[axis] - begin) continue;
    throw std::invalid_argument("coupler: a part of " + std::to_string(nodes) + " grid nodes from " +
                                std::to_string(begin) + " on along " + "xyz"[axis] + ", of a grid of " +
                                std::to_string(grid.nodes[axis]));
  }
}

GridPart region_of(const Grid& grid, const GridPart& part, int width) {
  GridPart region = whole_of(grid);
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_cut(grid, part, axis)) continue;
    int begin = part.begin[axis] - (width - 1), end = part.begin[axis] + part.nodes[axis] + (width - 1);
    if (grid.periodic[axis]) {
      if (end - begin >= grid.nodes[axis]) continue;
    } else {
      begin = std::max(begin, 0);
      end = std::min(end, grid.nodes[axis]);
    }
    region.begin[axis] = begin;
    region.nodes[axis] = end - begin;
  }
  return region;
}

Grid grid_of_region(const Grid& grid, const GridPart& region) {
  Grid result{region.nodes, grid.periodic};
  for (int axis = 0; axis < 3; ++axis) {
    if (is_cut(grid, region, axis)) result.periodic[axis] = false;
  }
  return result;
}

}  // namespace tanktread::coupler
