#include "coupler/node_selection.hpp"

#include <algorithm>
#include <numeric>

#include "coupler/grid_region.hpp"

namespace tanktread::coupler {
namespace {

void select_all(NodeSelection& nodes) {
  std::size_t longest = 0;
  for (const std::size_t n : nodes.n_nodes_of_surface) {
    nodes.first_stencil.push_back(nodes.first_stencil.back() + n);
    longest = std::max(longest, n);
  }
  const std::size_t known = nodes.home_numbers.size();
  if (longest <= known) return;
  nodes.home_numbers.resize(longest);
  std::iota(nodes.home_numbers.begin() + static_cast<std::ptrdiff_t>(known), nodes.home_numbers.end(),
            static_cast<std::int32_t>(known));
}

}  // namespace

NodeSelector::NodeSelector(const Grid& grid, const GridPart& part, const Kernel& kernel, int n_shares)
    : n_shares_(n_shares), found_(n_shares) {
  for (int axis = 0; axis < 3; ++axis) {
    if (is_cut(grid, part, axis)) cut_axes_.push_back({axis, AxisPart(grid, part, axis, kernel)});
  }
}

bool NodeSelector::is_touched_from(const double* position) const {
  return std::ranges::all_of(
      cut_axes_, [&](const CutAxis& cut) { return cut.part.is_touched_from(position[cut.axis]); });
}

bool NodeSelector::has_cell_of(const double* position) const {
  return std::ranges::all_of(cut_axes_,
                             [&](const CutAxis& cut) { return cut.part.has_cell_of(position[cut.axis]); });
}

void NodeSelector::find(const std::vector<std::size_t>& first_node,
                        std::span<const std::span<const double>> surfaces, NodeRange range,
                        Found& found) const {
  found.numbers.clear();
  found.is_home.clear();
  found.of_surface.assign(surfaces.size(), 0);
  SurfaceOfNode surface(first_node);
  for (std::size_t begin = range.begin, end; begin < range.end; begin = end) {
    const std::size_t s = surface.of(begin), before = found.numbers.size();
    end = std::min(range.end, first_node[s + 1]);
    for (std::size_t node = surface.node(begin), last = surface.node(end); node < last; ++node) {
      const double* position = &surfaces[s][3 * node];
      if (!is_touched_from(position)) continue;
      found.numbers.push_back(static_cast<std::int32_t>(node));
      found.is_home.push_back(has_cell_of(position));
    }
    found.of_surface[s] = found.numbers.size() - before;
  }
}

void NodeSelector::select(std::span<const std::span<const double>> surfaces, NodeSelection& nodes) {
  nodes.n_nodes_of_surface.clear();
  for (const auto& surface : surfaces) nodes.n_nodes_of_surface.push_back(surface.size() / 3);
  nodes.first_stencil.assign(1, 0);
  nodes.all = cut_axes_.empty();
  if (nodes.all) return select_all(nodes);
  std::vector<std::size_t> first_node = {0};
  for (const std::size_t n : nodes.n_nodes_of_surface) first_node.push_back(first_node.back() + n);
#pragma omp parallel for num_threads(n_shares_) schedule(static, 1)
  for (int share = 0; share < n_shares_; ++share)
    find(first_node, surfaces, NodeRange(first_node.back(), share, n_shares_), found_[share]);
  nodes.numbers.clear();
  nodes.home_numbers.clear();
  nodes.home_stencils.clear();
  nodes.first_home.assign(1, 0);
  std::vector<std::size_t> taken(n_shares_, 0);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    for (int share = 0; share < n_shares_; ++share) {
      const Found& found = found_[share];
      for (std::size_t end = taken[share] + found.of_surface[s]; taken[share] < end; ++taken[share]) {
        if (found.is_home[taken[share]] != 0) {
          nodes.home_stencils.push_back(nodes.numbers.size());
          nodes.home_numbers.push_back(found.numbers[taken[share]]);
        }
        nodes.numbers.push_back(found.numbers[taken[share]]);
      }
    }
    nodes.first_stencil.push_back(nodes.numbers.size());
    nodes.first_home.push_back(nodes.home_numbers.size());
  }
}

}  // namespace tanktread::coupler
