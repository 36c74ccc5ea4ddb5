// A part of a grid, and what the stencils of its nodes reach. Internal to the coupler.
#pragma once

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

inline GridPart whole_of(const Grid& grid) {
  return {{0, 0, 0}, grid.nodes};
}

/// Whether the part ends before the grid does along an axis.
inline bool is_cut(const Grid& grid, const GridPart& part, int axis) {
  return part.nodes[axis] < grid.nodes[axis];
}

inline bool is_whole(const Grid& grid, const GridPart& part) {
  return !is_cut(grid, part, 0) && !is_cut(grid, part, 1) && !is_cut(grid, part, 2);
}

/// A whole number of periods away from the number: 0 to `nodes` - 1.
inline int wrapped(std::int64_t number, int nodes) {
  if (number >= 0 && number < nodes) return static_cast<int>(number);
  const std::int64_t remainder = number % nodes;
  return static_cast<int>(remainder < 0 ? remainder + nodes : remainder);
}

/// @throws std::invalid_argument unless the part has nodes, all of them in the grid
void require_part(const Grid& grid, const GridPart& part);

/// Coupler::region() of a kernel that is `width` nodes wide.
GridPart region_of(const Grid& grid, const GridPart& part, int width);

/// The region as a grid of its own. It is periodic along an axis where it is as long as that of the grid.
Grid grid_of_region(const Grid& grid, const GridPart& region);

}  // namespace tanktread::coupler
