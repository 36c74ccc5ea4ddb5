#include "coupler/surface_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "coupler/axis_stencil.hpp"
#include "coupler/grid_region.hpp"
#include "coupler/surface_check.hpp"

namespace tanktread::coupler {
namespace {

constexpr char axis_name[] = {'x', 'y', 'z'};

/// An overlap of a surface with itself that is shorter along a row comes from rounding: that of positions of
/// a few thousand grid steps is 1e-12.
constexpr double shortest_overlap = 1e-9;

/// The number of the first node along an axis at or beyond a coordinate (within 2^31). It never falls where
/// the coordinate grows, which is all that is asked of it.
int first_node_from(double coordinate) {
  const double from_first_node = coordinate - 0.5;
  const int whole = static_cast<int>(from_first_node);  // towards zero
  return whole + (from_first_node > whole);
}

double node_position(int node) {
  return node + 0.5;
}

/// start + part (end - start)/whole. The product comes first: where all numbers are short and so is the
/// answer, it is exact.
double between(double start, double end, double part, double whole) {
  return start + part * (end - start) / whole;
}

std::string name_of(const RowSurface& surface) {
  return "coupler: surface " + std::to_string(surface.number);
}

/// The least and the greatest coordinates.
struct Box {
  std::array<double, 3> least, greatest;
};

/// @throws InsideError if a position is not finite or too far off
Box box_of(const RowSurface& surface, std::span<const double> positions) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t k = 0; k < positions.size(); k += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double position = positions[k + axis];
      if (!(std::abs(position) <= farthest_coordinate)) {
        std::ostringstream message;
        message << name_of(surface) << ", node " << k / 3 << ": " << axis_name[axis] << " = " << position
                << ", must be finite and within 2^30 of the origin";
        throw InsideError(message.str(), precedence_of(InsideFault::surface, surface.number));
      }
      box.least[axis] = std::min(box.least[axis], position);
      box.greatest[axis] = std::max(box.greatest[axis], position);
    }
  }
  return box;
}

/// What to add to a coordinate: whole periods that take the least into the grid.
double wrap_of(const Grid& grid, const RowSurface& surface, const Box& box, int axis) {
  if (!grid.periodic[axis]) return 0;
  const double period = grid.nodes[axis], extent = box.greatest[axis] - box.least[axis];
  if (extent > 2 * period) {
    std::ostringstream message;
    message << name_of(surface) << " spreads over " << extent << " along " << axis_name[axis]
            << ", at most two periods of " << period << " are allowed";
    throw InsideError(message.str(), precedence_of(InsideFault::surface, surface.number));
  }
  return -period * std::floor(box.least[axis] / period);
}

/// The nodes along an axis between two coordinates, the second excluded.
AxisRange range_between(const Grid& grid, int axis, double least, double greatest) {
  const AxisRange range{first_node_from(least), first_node_from(greatest)};
  if (grid.periodic[axis]) return range;
  return {std::clamp(range.begin, 0, grid.nodes[axis]), std::clamp(range.end, 0, grid.nodes[axis])};
}

/// Where a plane z = const. meets an edge.
struct Cut {
  const RowSurface::Node *below, *above;
  double y;
  int row;  ///< the first that is not before it

  /// One end is below the plane, the other is not, so that which is which does not depend on the triangle.
  Cut(const RowSurface::Node& lower, const RowSurface::Node& upper, double z)
      : below(&lower),
        above(&upper),
        y(between(lower.y, upper.y, z - lower.z, upper.z - lower.z)),
        row(first_node_from(y)) {}

  double x(double z) const { return between(below->x, above->x, z - below->z, above->z - below->z); }
};

/// @param node not wrapped
std::string name_of_node(const Grid& grid, std::array<int, 3> node) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.periodic[axis]) node[axis] = wrapped(node[axis], grid.nodes[axis]);
  }
  return "(" + std::to_string(node[0]) + ", " + std::to_string(node[1]) + ", " + std::to_string(node[2]) +
         ")";
}

/// The numbers of a range along an axis, not wrapped, that are of the part.
std::vector<AxisRange> ranges_of_part(const Grid& grid, const GridPart& part, int axis, AxisRange range) {
  if (!is_cut(grid, part, axis)) return {range};
  const int period = grid.nodes[axis];
  std::vector<AxisRange> ranges;
  // The range of a surface begins in the grid, or right behind it.
  for (int begin = part.begin[axis]; begin < range.end; begin += period) {
    const AxisRange common = {std::max(range.begin, begin), std::min(range.end, begin + part.nodes[axis])};
    if (common.begin < common.end) ranges.push_back(common);
    if (!grid.periodic[axis]) break;
  }
  return ranges;
}

/// Whether the part has nodes of a range along x or, where a surface's hole may be told, the one behind it.
bool meets(const Grid& grid, const GridPart& part, AxisRange columns) {
  ++columns.end;
  if (!grid.periodic[0]) {
    const int last = grid.nodes[0] - 1;
    columns = {std::min(columns.begin, last), std::max(std::min(columns.end, last + 1), 1)};
  }
  return !ranges_of_part(grid, part, 0, columns).empty();
}

bool proper(int winding_number) {
  return winding_number == 0 || winding_number == 1;
}

}  // namespace

void RowSurface::take_in(const Grid& grid, int surface, std::span<const double> positions,
                         std::span<const int> the_triangles) {
  number = surface;
  triangles = the_triangles;
  require_surface(positions.size(), triangles, "positions", positions.size());
  nodes.resize(positions.size() / 3);
  columns = rows = planes = {};
  if (nodes.empty()) return;
  const Box box = box_of(*this, positions);
  std::array<double, 3> wrap;
  for (int axis = 0; axis < 3; ++axis) wrap[axis] = wrap_of(grid, *this, box, axis);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double* position = &positions[3 * k];
    nodes[k] = {position[0] + wrap[0], position[1] + wrap[1], position[2] + wrap[2], 0};
    nodes[k].plane = first_node_from(nodes[k].z);
  }
  columns = range_between(grid, 0, box.least[0] + wrap[0], box.greatest[0] + wrap[0]);
  rows = range_between(grid, 1, box.least[1] + wrap[1], box.greatest[1] + wrap[1]);
  planes = range_between(grid, 2, box.least[2] + wrap[2], box.greatest[2] + wrap[2]);
}

void add_blocks(const Grid& grid, const GridPart& part, const RowSurface& surface,
                std::vector<RowBlock>& blocks) {
  if (!meets(grid, part, surface.columns)) return;
  for (const AxisRange planes : ranges_of_part(grid, part, 2, surface.planes)) {
    for (const AxisRange rows : ranges_of_part(grid, part, 1, surface.rows))
      blocks.push_back({&surface, rows, planes});
  }
}

void RowScan::find(const Grid& grid, const GridPart& part, const RowBlock& block) {
  found_.clear();
  runs_.clear();
  fault_.reset();
  const AxisRange rows = block.rows, planes = block.planes;
  const int n_rows = rows.end - rows.begin;
  cross(block);
  sort_by_row(std::size_t{1} * n_rows * (planes.end - planes.begin));
  std::size_t begin = 0;
  while (begin < crossings_.size() && !fault_) {
    const int row = crossings_[begin].row;
    std::size_t end = begin + 1;
    while (end < crossings_.size() && crossings_[end].row == row) ++end;
    fill(grid, part, *block.surface, {rows.begin + row % n_rows, planes.begin + row / n_rows},
         std::span(crossings_).subspan(begin, end - begin));
    begin = end;
  }
}

// All crossings of the rows of the block.
void RowScan::cross(const RowBlock& block) {
  const RowSurface& surface = *block.surface;
  const AxisRange rows = block.rows, planes = block.planes;
  const int n_rows = rows.end - rows.begin;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const std::array<const RowSurface::Node*, 3> corners = {&surface.nodes[surface.triangles[t]],
                                                            &surface.nodes[surface.triangles[t + 1]],
                                                            &surface.nodes[surface.triangles[t + 2]]};
    const int a = corners[0]->plane, b = corners[1]->plane, c = corners[2]->plane;
    const int end = std::min(std::max(std::max(a, b), c), planes.end);
    for (int plane = std::max(std::min(std::min(a, b), c), planes.begin); plane < end; ++plane)
      cross(corners, plane, rows, (plane - planes.begin) * n_rows);
  }
}

// The crossings of a triangle with the rows of one plane, which has one or two corners below it.
void RowScan::cross(const std::array<const RowSurface::Node*, 3>& corners, int plane, AxisRange rows,
                    int first_row) {
  const double z = node_position(plane);
  // Without branches, of which no processor could tell the outcome: the corner that is alone on its side of
  // the plane, by which corners are above, a bit each.
  constexpr int next_of[] = {1, 2, 0}, last_of[] = {2, 0, 1};
  constexpr int alone_of[] = {0, 0, 1, 2, 2, 1, 0, 0};
  const int above =
      (corners[0]->plane > plane) + 2 * (corners[1]->plane > plane) + 4 * (corners[2]->plane > plane);
  const int alone = alone_of[above];
  const bool alone_above = (above >> alone & 1) != 0;
  const RowSurface::Node *corner = corners[alone], *next = corners[next_of[alone]],
                         *last = corners[last_of[alone]];
  const Cut to_next(*(alone_above ? next : corner), *(alone_above ? corner : next), z),
      to_last(*(alone_above ? last : corner), *(alone_above ? corner : last), z);
  if (to_next.row == to_last.row) return;
  // In the order of y, so that the triangle's neighbour in another surface, which is the same triangle turned
  // over, has the same crossings.
  const bool ascending = to_next.row < to_last.row;
  const Cut &first = ascending ? to_next : to_last, &second = ascending ? to_last : to_next;
  const double x = first.x(z), other_x = second.x(z);
  const int end = std::min(second.row, rows.end);
  // Seen along -x, with y to the right and z up, an outer side is counter-clockwise: its boundary goes up at
  // the greater y.
  const bool leaving = alone_above == ascending;
  for (int row = std::max(first.row, rows.begin); row < end; ++row) {
    found_.push_back({between(x, other_x, node_position(row) - first.y, second.y - first.y),
                      first_row + row - rows.begin, leaving});
  }
}

void RowScan::sort_by_row(std::size_t n_rows) {
  next_in_row_.assign(n_rows + 1, 0);
  for (const Crossing& crossing : found_) ++next_in_row_[crossing.row + 1];
  for (std::size_t row = 0; row < n_rows; ++row) next_in_row_[row + 1] += next_in_row_[row];
  crossings_.resize(found_.size());
  for (const Crossing& crossing : found_) crossings_[next_in_row_[crossing.row]++] = crossing;
}

// The runs between the crossings of one row.
void RowScan::fill(const Grid& grid, const GridPart& part, const RowSurface& surface, Row row,
                   std::span<Crossing> crossings) {
  const auto refuse = [&](const std::string& what, int x) {
    fault_.emplace(name_of(surface) + what + " at grid node " + name_of_node(grid, {x, row.y, row.z}),
                   precedence_of(InsideFault::row, surface.number, surface.row_number(row.y, row.z)));
  };
  std::ranges::sort(crossings, {}, &Crossing::x);
  int winding_number = 0;
  for (const Crossing& crossing : crossings) winding_number += crossing.leaving ? -1 : 1;
  if (winding_number != 0) {
    return refuse(" is not closed: the row along x goes through a hole. It first meets the surface",
                  first_node_from(crossings.front().x));
  }
  AxisRange inside, wrong;
  double wrong_from = 0;
  for (const Crossing& crossing : crossings) {
    const int before = winding_number, node = first_node_from(crossing.x);
    winding_number += crossing.leaving ? -1 : 1;
    if (proper(before) && !proper(winding_number)) {
      wrong.begin = node;
      wrong_from = crossing.x;
    } else if (!proper(before) && proper(winding_number) && wrong.begin < node &&
               crossing.x - wrong_from > shortest_overlap) {
      return refuse(before < 0 ? " has its inside out" : " overlaps itself", wrong.begin);
    }
    if (before == 0 && winding_number == 1) inside.begin = node;
    if (before == 1 && winding_number == 0) add(grid, part, surface, row, {inside.begin, node});
  }
}

// A run of nodes along x, wrapped or cut at the walls. It is not cut where the part ends: runs that overlap
// shall do so at the same node, whatever the part is.
void RowScan::add(const Grid& grid, const GridPart& part, const RowSurface& surface, Row row,
                  AxisRange nodes) {
  const int nx = grid.nodes[0];
  if (!grid.periodic[0]) nodes = {std::max(nodes.begin, 0), std::min(nodes.end, nx)};
  const int plane = wrapped(row.z, grid.nodes[2]);
  const std::int64_t row_begin = (std::int64_t{plane} * grid.nodes[1] + wrapped(row.y, grid.nodes[1])) * nx;
  for (int begin = nodes.begin, length; begin < nodes.end; begin += length) {
    const int x = wrapped(begin, nx);
    length = std::min(nodes.end - begin, nx - x);
    if (x + length <= part.begin[0] || x >= part.begin[0] + part.nodes[0]) continue;
    runs_.push_back({row_begin + x, row_begin + x + length, surface.number + 1, plane - part.begin[2]});
  }
}

}  // namespace tanktread::coupler
