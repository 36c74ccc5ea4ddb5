#include "coupler/stencils.hpp"

#include <algorithm>
#include <sstream>

namespace tanktread::coupler {
namespace {

constexpr char axis_name[] = {'x', 'y', 'z'};

/// Index of the k-th grid node of a stencil along an axis.
int index_of(int first, int k, int nodes) {
  const int index = first + k;
  return index < nodes ? index : index - nodes;
}

}  // namespace

StencilBuilder::StencilBuilder(const Grid& grid, const Kernel& kernel, int shares)
    : grid_(grid),
      kernel_(kernel),
      width_(width_of(kernel)),
      shares_(shares),
      axes_{AxisStencil(grid.nodes[0], grid.periodic[0], kernel_),
            AxisStencil(grid.nodes[1], grid.periodic[1], kernel_),
            AxisStencil(grid.nodes[2], grid.periodic[2], kernel_)},
      marks_(grid),
      share_of_plane_(grid.nodes[2]) {
  // Neighbouring planes go to different shares: every stencil then has work for up to `width` of them.
  for (int z = 0; z < grid.nodes[2]; ++z) share_of_plane_[z] = z % shares;
}

void StencilBuilder::build(std::span<const std::span<const double>> surfaces, Stencils& stencils) {
  resize(surfaces, stencils);
  weigh(surfaces, stencils);
  place_across(stencils);
  mark(stencils);
  marks_.number(stencils.grid_nodes);
  find_runs(stencils);
}

void StencilBuilder::resize(std::span<const std::span<const double>> surfaces, Stencils& stencils) const {
  stencils.width = width_;
  stencils.first_node.assign(1, 0);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces[s].size() % 3 != 0) {
      throw std::invalid_argument("coupler: surface " + std::to_string(s) + " has " +
                                  std::to_string(surfaces[s].size()) +
                                  " coordinates; 3 numbers a node are needed");
    }
    stencils.first_node.push_back(stencils.n_nodes() + surfaces[s].size() / 3);
  }
  const std::size_t n = stencils.n_nodes();
  stencils.weights.resize(3 * n * width_);
  stencils.first.resize(n);
  stencils.run.resize(n * width_ * width_);
  stencils.across.resize(n);
}

// Weights and lowest grid indices; refuses the first node (by its number) that has no stencil.
void StencilBuilder::weigh(std::span<const std::span<const double>> surfaces, Stencils& stencils) const {
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const double* positions = surfaces[s].data();
    const std::size_t n = surfaces[s].size() / 3, before = stencils.first_node[s];
    std::size_t first_refused = n;
#pragma omp parallel for num_threads(shares_) schedule(static) reduction(min : first_refused)
    for (std::size_t node = 0; node < n; ++node) {
      const std::size_t m = before + node;
      for (int axis = 0; axis < 3; ++axis) {
        const Fit fit = axes_[axis].fit(positions[3 * node + axis], stencils.first[m][axis],
                                        &stencils.weights[(3 * m + axis) * width_]);
        if (fit != Fit::inside) first_refused = std::min(first_refused, node);
      }
    }
    if (first_refused < n) refuse(s, first_refused, &positions[3 * first_refused]);
  }
}

// Gives each stencil across the periodic face of x its place.
void StencilBuilder::place_across(Stencils& stencils) const {
  std::int32_t places = 0;
  for (std::size_t m = 0; m < stencils.n_nodes(); ++m)
    stencils.across[m] = stencils.first[m][0] + width_ > grid_.nodes[0] ? places++ : -1;
  stencils.across_run.resize(std::size_t{1} * places * width_ * width_);
}

template <class Visit>
void StencilBuilder::visit_rows(const std::array<int, 3>& first, int z, const Visit& visit) const {
  const int width = width_, ny = grid_.nodes[1], y = first[1];
  const std::int64_t plane = std::int64_t{z} * ny;
  for (int ky = 0; ky < width; ++ky) visit(plane + index_of(y, ky, ny));
}

void StencilBuilder::mark(const Stencils& stencils) {
  marks_.clear();
#pragma omp parallel for num_threads(shares_) schedule(static, 1)
  for (int share = 0; share < shares_; ++share) {
    const int width = width_, nx = grid_.nodes[0], nz = grid_.nodes[2];
    for (const auto& first : stencils.first) {
      const int before_face = std::min(width, nx - first[0]);
      const GridMarks::Run run(first[0], before_face);
      for (int kz = 0; kz < width; ++kz) {
        const int z = index_of(first[2], kz, nz);
        if (share_of_plane_[z] != share) continue;
        visit_rows(first, z, [&](std::int64_t row) { marks_.mark(row, run); });
        if (before_face == width) continue;
        const GridMarks::Run across(0, width - before_face);
        visit_rows(first, z, [&](std::int64_t row) { marks_.mark(row, across); });
      }
    }
  }
}

void StencilBuilder::find_runs(Stencils& stencils) const {
  const std::size_t n = stencils.n_nodes();
#pragma omp parallel for num_threads(shares_) schedule(static)
  for (std::size_t m = 0; m < n; ++m) {
    const auto& first = stencils.first[m];
    list_numbers(first, first[0], &stencils.run[m * width_ * width_]);
    const std::int32_t across = stencils.across[m];
    if (across >= 0) list_numbers(first, 0, &stencils.across_run[std::size_t{1} * across * width_ * width_]);
  }
}

// The number of the grid node x in each row of a stencil.
void StencilBuilder::list_numbers(const std::array<int, 3>& first, int x, std::int32_t* numbers) const {
  const int width = width_, nz = grid_.nodes[2];
  const GridMarks::Place place(x);
  for (int kz = 0; kz < width; ++kz) {
    visit_rows(first, index_of(first[2], kz, nz),
               [&](std::int64_t row) { *numbers++ = marks_.number_of(row, place); });
  }
}

void StencilBuilder::refuse(std::size_t surface, std::size_t node, const double* position) const {
  std::ostringstream message;
  message.precision(8);
  message << "coupler: surface " << surface << ", node " << node << " at (" << position[0] << ", "
          << position[1] << ", " << position[2] << "): ";
  for (int axis = 0; axis < 3; ++axis) {
    const double x = position[axis];
    const double length = grid_.nodes[axis];
    int first = 0;
    double weights[max_width];
    const Fit fit = axes_[axis].fit(x, first, weights);
    if (fit == Fit::inside) continue;
    if (fit == Fit::not_finite) {
      message << axis_name[axis] << " is not finite";
    } else if (fit == Fit::too_far) {
      message << axis_name[axis] << " is more than " << farthest_coordinate
              << " grid steps from the origin, where a position no longer resolves the grid";
    } else {
      // The first node beyond a wall is half a grid step behind it.
      const bool low = x < 0.5 * length;
      message << "its distance from the wall at " << axis_name[axis] << " = " << (low ? 0.0 : length)
              << " is " << (low ? x : length - x) << " grid steps; kernel '" << kernel_.name
              << "' of half-width " << kernel_.half_width << " needs at least " << kernel_.half_width - 0.5;
    }
    throw StencilError(message.str());
  }
  throw std::logic_error("coupler: a node that fits was refused");
}

}  // namespace tanktread::coupler
