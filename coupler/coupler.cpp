#include "coupler/coupler.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/stencils.hpp"

namespace tanktread::coupler {
namespace {

void check_kernel(const Kernel& kernel) {
  if (kernel.function == nullptr ||
      !(2.0 * kernel.half_width > 1.0 && 2.0 * kernel.half_width <= max_width)) {
    throw std::invalid_argument("coupler: kernel '" + kernel.name +
                                "' needs a function and a half-width above 1/2 and at most " +
                                std::to_string(max_width / 2) + " grid steps");
  }
}

void check_grid(const Grid& grid, const Kernel& kernel) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.nodes[axis] >= width_of(kernel)) continue;
    throw std::invalid_argument(std::string("coupler: axis ") + "xyz"[axis] + " has " +
                                std::to_string(grid.nodes[axis]) + " grid nodes, but kernel '" + kernel.name +
                                "' is " + std::to_string(width_of(kernel)) +
                                " wide: use at least as many nodes, or a narrower kernel");
  }
}

int check_threads(int threads) {
  if (threads < 0)
    throw std::invalid_argument("coupler: threads = " + std::to_string(threads) +
                                "; 0 (all) or more is needed");
  return threads > 0 ? threads : omp_get_max_threads();
}

/// @throws std::invalid_argument unless an array has as many numbers as it must
void check_size(const std::string& what, std::size_t size, std::size_t needed) {
  if (size == needed) return;
  throw std::invalid_argument("coupler: " + what + ": " + std::to_string(size) + " given, " +
                              std::to_string(needed) + " needed");
}

/// `surfaces` must be as many, and as long, as those that the stencils were built for.
template <class Surfaces>
void check_surfaces(const std::string& what, const Surfaces& surfaces, const Stencils& stencils) {
  check_size(what + ", surfaces", surfaces.size(), stencils.n_surfaces());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    check_size(what + ", numbers of surface " + std::to_string(s), surfaces[s].size(),
               3 * (stencils.first_node[s + 1] - stencils.first_node[s]));
  }
}

/// The stencil of one membrane node, for loops whose length the compiler knows.
template <int width>
struct NodeStencil {
  static constexpr int row_length = 3 * width;  ///< numbers in a row: 3 components of `width` grid nodes

  NodeStencil(const Stencils& stencils, std::size_t m, int nodes_along_x)
      : x(&stencils.weights[3 * width * m]),
        y(x + width),
        z(y + width),
        run(&stencils.run[width * width * m]) {
    if (stencils.across[m] < 0) return;
    across_run = &stencils.across_run[std::size_t{1} * width * width * stencils.across[m]];
    length_before_face = 3 * (nodes_along_x - stencils.first[m][0]);
  }

  const double *x, *y, *z;                   ///< weights along each axis
  const std::int32_t* run;                   ///< number of the first grid node of each row
  const std::int32_t* across_run = nullptr;  ///< that of the part behind the periodic face of x
  int length_before_face = row_length;       ///< numbers of a row before that face
};

/// Row `row` of a grid array: in place where it lies in one piece, else gathered into `pieces`.
template <int width>
const double* row_of(const NodeStencil<width>& stencil, const double* grid, int row, double* pieces) {
  const double* start = grid + 3 * std::int64_t{stencil.run[row]};
  if (!stencil.across_run) return start;
  const int before = stencil.length_before_face;
  std::copy_n(start, before, pieces);
  std::copy_n(grid + 3 * std::int64_t{stencil.across_run[row]}, stencil.row_length - before, pieces + before);
  return pieces;
}

template <int width>
void interpolate_node(const NodeStencil<width>& stencil, const double* grid_velocity, double* velocity) {
  constexpr int length = NodeStencil<width>::row_length;
  double sum[length] = {}, pieces[length];
  for (int kz = 0, row = 0; kz < width; ++kz) {
    for (int ky = 0; ky < width; ++ky, ++row) {
      const double weight = stencil.z[kz] * stencil.y[ky];
      const double* u = row_of(stencil, grid_velocity, row, pieces);
      for (int k = 0; k < length; ++k) sum[k] += weight * u[k];
    }
  }
  for (int component = 0; component < 3; ++component) {
    double total = 0.0;
    for (int kx = 0; kx < width; ++kx) total += stencil.x[kx] * sum[3 * kx + component];
    velocity[component] = total;
  }
}

/// Adds to the plane kz of the stencil. @param spread_along_x the force times the weights along x
template <int width>
void spread_to_plane(const NodeStencil<width>& stencil, int kz, const double* spread_along_x,
                     double* grid_force) {
  constexpr int length = NodeStencil<width>::row_length;
  for (int ky = 0; ky < width; ++ky) {
    const int row = kz * width + ky;
    const double weight = stencil.z[kz] * stencil.y[ky];
    double* target = grid_force + 3 * std::int64_t{stencil.run[row]};
    if (!stencil.across_run) {
      for (int k = 0; k < length; ++k) target[k] += weight * spread_along_x[k];
      continue;
    }
    const int before = stencil.length_before_face;
    double* behind = grid_force + 3 * std::int64_t{stencil.across_run[row]};
    for (int k = 0; k < before; ++k) target[k] += weight * spread_along_x[k];
    for (int k = before; k < length; ++k) behind[k - before] += weight * spread_along_x[k];
  }
}

/// Calls function.operator()<width>() for a width known at run time only.
template <class Function>
void for_width(int width, const Function& function) {
  switch (width) {
    case 2:
      return function.template operator()<2>();
    case 3:
      return function.template operator()<3>();
    case 4:
      return function.template operator()<4>();
    case 5:
      return function.template operator()<5>();
    case 6:
      return function.template operator()<6>();
    default:
      throw std::logic_error("coupler: no stencil loop of width " + std::to_string(width));
  }
  static_assert(max_width == 6);
}

}  // namespace

struct Coupler::Implementation {
  Implementation(const Grid& the_grid, const Kernel& kernel, int n_shares)
      : grid(the_grid), shares(n_shares), builder(the_grid, kernel, n_shares) {}

  template <int width>
  void interpolate(std::span<const double> grid_velocity, std::span<const std::span<double>> velocity) const {
    for (std::size_t s = 0; s < velocity.size(); ++s) {
      const std::size_t before = stencils.first_node[s], n = velocity[s].size() / 3;
#pragma omp parallel for num_threads(shares) schedule(static)
      for (std::size_t node = 0; node < n; ++node) {
        const NodeStencil<width> stencil(stencils, before + node, grid.nodes[0]);
        interpolate_node(stencil, grid_velocity.data(), &velocity[s][3 * node]);
      }
    }
  }

  // Each share owns grid planes and goes through all membrane nodes in order: every grid node receives its
  // parts in the order of the membrane nodes, however many shares there are.
  template <int width>
  void spread(std::span<const std::span<const double>> node_force, std::span<double> grid_force) const {
#pragma omp parallel num_threads(shares)
    {
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < grid_force.size(); ++k) grid_force[k] = 0.0;
#pragma omp for schedule(static, 1)
      for (int share = 0; share < shares; ++share) spread_share<width>(share, node_force, grid_force.data());
    }
  }

  template <int width>
  void spread_share(int share, std::span<const std::span<const double>> node_force,
                    double* grid_force) const {
    for (std::size_t s = 0; s < node_force.size(); ++s) {
      const std::size_t before = stencils.first_node[s], n = node_force[s].size() / 3;
      for (std::size_t node = 0; node < n; ++node) {
        const std::size_t m = before + node;
        const NodeStencil<width> stencil(stencils, m, grid.nodes[0]);
        double along_x[NodeStencil<width>::row_length];
        for (int kx = 0; kx < width; ++kx) {
          for (int component = 0; component < 3; ++component)
            along_x[3 * kx + component] = stencil.x[kx] * node_force[s][3 * node + component];
        }
        int z = stencils.first[m][2];
        for (int kz = 0; kz < width; ++kz) {
          if (builder.share_of_plane(z) == share) spread_to_plane(stencil, kz, along_x, grid_force);
          if (++z == grid.nodes[2]) z = 0;
        }
      }
    }
  }

  Grid grid;
  int shares;
  StencilBuilder builder;
  Stencils stencils;  ///< in use
  Stencils next;      ///< being built, so that the old ones stay if that fails
};

Coupler::Coupler(const Grid& grid, const Kernel& kernel, int threads) {
  check_kernel(kernel);
  check_grid(grid, kernel);
  implementation_ = std::make_unique<Implementation>(grid, kernel, check_threads(threads));
}

Coupler::~Coupler() = default;

const Kernel& Coupler::kernel() const {
  return implementation_->builder.kernel();
}

void Coupler::build(std::span<const std::span<const double>> surfaces) {
  implementation_->builder.build(surfaces, implementation_->next);
  std::swap(implementation_->stencils, implementation_->next);
}

std::span<const std::int64_t> Coupler::grid_nodes() const {
  return implementation_->stencils.grid_nodes;
}

void Coupler::interpolate(std::span<const double> grid_velocity,
                          std::span<const std::span<double>> node_velocity) const {
  const Stencils& stencils = implementation_->stencils;
  check_size("interpolate, grid_velocity", grid_velocity.size(), 3 * stencils.grid_nodes.size());
  check_surfaces("interpolate, node_velocity", node_velocity, stencils);
  if (stencils.n_nodes() == 0) return;
  for_width(stencils.width,
            [&]<int width>() { implementation_->interpolate<width>(grid_velocity, node_velocity); });
}

void Coupler::spread(std::span<const std::span<const double>> node_force,
                     std::span<double> grid_force) const {
  const Stencils& stencils = implementation_->stencils;
  check_surfaces("spread, node_force", node_force, stencils);
  check_size("spread, grid_force", grid_force.size(), 3 * stencils.grid_nodes.size());
  if (stencils.n_nodes() == 0) return;
  for_width(stencils.width, [&]<int width>() { implementation_->spread<width>(node_force, grid_force); });
}

}  // namespace tanktread::coupler
