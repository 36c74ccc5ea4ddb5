#include "coupler/coupler.hpp"

#include <algorithm>
#include <utility>

#include "coupler/threads.hpp"
#include "coupler/transfer.hpp"

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

}  // namespace

Coupler::Coupler(const Grid& grid, const Kernel& kernel, int threads)
    : Coupler(grid, whole_of(grid), kernel, threads) {}

Coupler::Coupler(const Grid& grid, const GridPart& part, const Kernel& kernel, int threads) {
  check_kernel(kernel);
  check_grid(grid, kernel);
  require_part(grid, part);
  implementation_ = std::make_unique<Implementation>(grid, part, kernel, number_of_threads(threads));
}

Coupler::~Coupler() = default;

const Kernel& Coupler::kernel() const {
  return implementation_->builder.kernel();
}

const GridPart& Coupler::region() const {
  return implementation_->builder.region();
}

void Coupler::build(std::span<const std::span<const double>> surfaces, std::span<const ShearDipole> dipoles) {
  implementation_->builder.build(surfaces, dipoles, implementation_->next);
  std::swap(implementation_->stencils, implementation_->next);
}

std::span<const std::int32_t> Coupler::home_nodes(std::size_t surface) const {
  const Stencils& stencils = implementation_->stencils;
  if (surface >= stencils.n_surfaces()) {
    throw std::invalid_argument("coupler: nodes at home of surface " + std::to_string(surface) + " of " +
                                std::to_string(stencils.n_surfaces()));
  }
  return stencils.nodes.home_nodes(surface);
}

std::span<const std::int64_t> Coupler::grid_nodes() const {
  return *implementation_->stencils.grid_nodes;
}

std::shared_ptr<const std::vector<std::int64_t>> Coupler::grid_node_list() const {
  return implementation_->stencils.grid_nodes;
}

void Coupler::interpolate(std::span<const double> grid_velocity,
                          std::span<const std::span<double>> node_velocity) const {
  const Stencils& stencils = implementation_->stencils;
  check_size("interpolate, grid_velocity", grid_velocity.size(), 3 * stencils.grid_nodes->size());
  implementation_->check_surfaces("interpolate, node_velocity", node_velocity);
  implementation_->interpolate(With::dipoles, grid_velocity,
                               [&](std::size_t surface, std::size_t node, const double* velocity) {
                                 std::copy_n(velocity, 3, &node_velocity[surface][3 * node]);
                               });
}

void Coupler::spread(std::span<const std::span<const double>> node_force,
                     std::span<double> grid_force) const {
  const Stencils& stencils = implementation_->stencils;
  implementation_->check_surfaces("spread, node_force", node_force);
  check_size("spread, grid_force", grid_force.size(), 3 * stencils.grid_nodes->size());
  implementation_->spread(
      With::dipoles,
      [&](std::size_t surface, std::size_t node, double* force) {
        std::copy_n(&node_force[surface][3 * node], 3, force);
      },
      grid_force);
}

}  // namespace tanktread::coupler
