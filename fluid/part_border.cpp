#include "fluid/part_border.hpp"

#include <algorithm>

#include "fluid/d3q19.hpp"

namespace tanktread::fluid {
namespace {

constexpr int n_axes = 3;
using Triple = std::array<int, n_axes>;

/// Populations along direction i cross the cuts that a neighbour in `direction` lies behind, and no other.
bool goes_along(int i, const Triple& direction) {
  for (int axis = 0; axis < n_axes; ++axis)
    if (direction[axis] != 0 && d3q19::velocity[i][axis] != direction[axis]) return false;
  return true;
}

}  // namespace

PartBorder::PartBorder(const GridShape& box, const std::optional<WallPair>& walls, const GridPart& part)
    : box_{box.nx, box.ny, box.nz},
      begin_(part.begin),
      n_{part.shape.nx, part.shape.ny, part.shape.nz},
      halo_{n_[0] < box_[0], n_[1] < box_[1], n_[2] < box_[2]},
      wall_axis_(walls ? walls->axis : -1) {}

bool PartBorder::has_neighbour(const Triple& direction) const {
  bool other = false;
  for (int axis = 0; axis < n_axes; ++axis) {
    if (direction[axis] == 0) continue;
    if (!is_cut(axis)) return false;
    const int behind = direction[axis] < 0 ? begin_[axis] - 1 : begin_[axis] + n_[axis];
    if (wall_axis_ == axis && (behind < 0 || behind >= box_[axis])) return false;
    other = true;
  }
  return other;
}

std::int64_t CrossingLinks::size() const {
  std::int64_t size = 1;
  for (int axis = 0; axis < n_axes; ++axis) size *= std::max(0, end[axis] - begin[axis]);
  return size;
}

std::vector<CrossingLinks> crossing_links(const PartBorder& border, const Triple& direction, bool beyond) {
  Triple along = direction;
  if (beyond) {
    for (int& component : along) component = -component;
  }
  std::vector<CrossingLinks> found;
  for (int i = 1; i < d3q19::n_directions; ++i) {
    if (!goes_along(i, along)) continue;
    CrossingLinks links{i, {}, {}};
    for (int axis = 0; axis < n_axes; ++axis) {
      const int c = d3q19::velocity[i][axis], n = border.n()[axis];
      if (direction[axis] != 0) {
        links.begin[axis] = direction[axis] < 0 ? (beyond ? -1 : 0) : n - (beyond ? 0 : 1);
        links.end[axis] = links.begin[axis] + 1;
      } else {
        const bool wraps = border.wraps(axis);
        links.begin[axis] = wraps ? 0 : std::max(0, -c);
        links.end[axis] = wraps ? n : n - std::max(0, c);
      }
    }
    if (links.size() > 0) found.push_back(links);
  }
  return found;
}

std::vector<Triple> halo_directions(const PartBorder& border) {
  std::vector<Triple> directions;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Triple direction = {x, y, z};
        if (border.has_neighbour(direction) && !crossing_links(border, direction, false).empty())
          directions.push_back(direction);
      }
    }
  }
  return directions;
}

}  // namespace tanktread::fluid
