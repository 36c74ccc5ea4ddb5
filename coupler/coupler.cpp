#include "coupler/coupler.hpp"

#include <omp.h>

#include <algorithm>

#include "coupler/stencils.hpp"

namespace tanktread::coupler {

struct Coupler::Implementation {
  Implementation(const Grid& grid, const Kernel& kernel, int threads)
      : n_threads(threads > 0 ? threads : omp_get_max_threads()), stencils(grid, kernel, n_threads) {}

  int n_threads;
  Stencils stencils;
};

namespace {

/// Throws unless there is an array of 3 numbers a node for every surface.
template <typename Span>
void check_surfaces(std::span<const Span> arrays, const std::vector<std::int64_t>& begin) {
  bool fits = arrays.size() + 1 == begin.size();
  for (std::size_t s = 0; fits && s < arrays.size(); ++s) {
    fits = static_cast<std::int64_t>(arrays[s].size()) == 3 * (begin[s + 1] - begin[s]);
  }
  if (!fits)
    throw std::invalid_argument("coupler: the arrays do not match the surfaces the stencils were built for");
}

void check_grid(std::size_t size, std::size_t n_touched) {
  if (size != 3 * n_touched)
    throw std::invalid_argument("coupler: a grid array needs 3 numbers for each of grid_nodes()");
}

void interpolate_node(const Stencils& stencils, std::int64_t node, std::span<const double> grid,
                      double* value) {
  const auto& weight = stencils.stencil(node).weight;
  const int n = stencils.n_points(), before = stencils.points_before_wrap(node);
  double sum[3] = {0, 0, 0};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      const auto& run = stencils.run(node, j, k);
      double row[3] = {0, 0, 0};
      for (int i = 0; i < n; ++i) {
        const double* u = &grid[3 * (i < before ? run.start + i : run.wrapped + i - before)];
        for (int component = 0; component < 3; ++component) row[component] += weight[0][i] * u[component];
      }
      const double weight_yz = weight[1][j] * weight[2][k];
      for (int component = 0; component < 3; ++component) sum[component] += weight_yz * row[component];
    }
  }
  std::copy_n(sum, 3, value);
}

/// Spreads one node's force onto the k-th layer of its box.
void spread_layer(const Stencils& stencils, std::int64_t node, int k, const double* force,
                  std::span<double> grid) {
  const auto& weight = stencils.stencil(node).weight;
  const int n = stencils.n_points(), before = stencils.points_before_wrap(node);
  for (int j = 0; j < n; ++j) {
    const auto& run = stencils.run(node, j, k);
    const double weight_yz = weight[1][j] * weight[2][k];
    for (int i = 0; i < n; ++i) {
      double* target = &grid[3 * (i < before ? run.start + i : run.wrapped + i - before)];
      const double share = weight_yz * weight[0][i];
      for (int component = 0; component < 3; ++component) target[component] += share * force[component];
    }
  }
}

}  // namespace

Coupler::Coupler(const Grid& grid, const Kernel& kernel, int threads)
    : implementation_(std::make_unique<Implementation>(grid, kernel, threads)) {}

Coupler::~Coupler() = default;

void Coupler::build(std::span<const std::span<const double>> surfaces) {
  implementation_->stencils.build(surfaces);
}

std::span<const std::int64_t> Coupler::grid_nodes() const {
  return implementation_->stencils.touched();
}

void Coupler::interpolate(std::span<const double> grid_velocity,
                          std::span<const std::span<double>> node_velocity) const {
  const auto& stencils = implementation_->stencils;
  const auto& begin = stencils.surface_begin();
  check_surfaces(node_velocity, begin);
  check_grid(grid_velocity.size(), stencils.touched().size());
  for (std::size_t s = 0; s < node_velocity.size(); ++s) {
    const std::int64_t n = begin[s + 1] - begin[s];
#pragma omp parallel for num_threads(implementation_->n_threads) schedule(static)
    for (std::int64_t node = 0; node < n; ++node) {
      interpolate_node(stencils, begin[s] + node, grid_velocity, &node_velocity[s][3 * node]);
    }
  }
}

void Coupler::spread(std::span<const std::span<const double>> node_force,
                     std::span<double> grid_force) const {
  const auto& stencils = implementation_->stencils;
  const auto& begin = stencils.surface_begin();
  check_surfaces(node_force, begin);
  check_grid(grid_force.size(), stencils.touched().size());
  std::fill(grid_force.begin(), grid_force.end(), 0.0);
  // Each thread owns every n-th plane of the grid and walks all membrane nodes in their order: a grid node's
  // sum is always made by one thread, in the same order, whatever the number of threads.
  const int n_owners = implementation_->n_threads;
#pragma omp parallel for num_threads(n_owners) schedule(static, 1)
  for (int owner = 0; owner < n_owners; ++owner) {
    for (std::size_t s = 0; s < node_force.size(); ++s) {
      for (std::int64_t node = begin[s]; node < begin[s + 1]; ++node) {
        for (int k = 0; k < stencils.n_points(); ++k) {
          if (stencils.plane(node, k) % n_owners != owner) continue;
          spread_layer(stencils, node, k, &node_force[s][3 * (node - begin[s])], grid_force);
        }
      }
    }
  }
}

}  // namespace tanktread::coupler
