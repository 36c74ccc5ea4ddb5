#include "coupler/tangential_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "coupler/products.hpp"
#include "coupler/transfer.hpp"

namespace tanktread::coupler {
namespace {

/// Mean over the phases of a node between two grid nodes of sum_i sum_j phi(i - s) phi(j - s) factor(|i -
/// j|).
template <class Factor>
double mean_of_pairs(const Kernel& kernel, const Factor& factor) {
  constexpr int n_phases = 1024;  // midpoints: the kinks of all kernels lie between two
  const int reach = static_cast<int>(std::ceil(kernel.half_width));
  double sum = 0;
  for (int phase = 0; phase < n_phases; ++phase) {
    const double s = (phase + 0.5) / n_phases;
    for (int i = -reach; i <= reach + 1; ++i) {
      for (int j = -reach; j <= reach + 1; ++j) {
        sum += kernel.function(i - s) * kernel.function(j - s) * factor(std::abs(i - j));
      }
    }
  }
  return sum / n_phases;
}

double square_sum(const Kernel& kernel) {
  return mean_of_pairs(kernel, [](int distance) { return distance == 0 ? 1.0 : 0.0; });
}

using Vector = std::array<double, 3>;

/// `vector` without its part along `normal`.
Vector tangential(const double* normal, const double* vector) {
  const double along = dot(normal, vector);
  Vector result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = vector[axis] - along * normal[axis];
  return result;
}

bool is_finite(const double* vector) {
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

/// The first node of a surface whose vector is not finite, if there is one.
/// @param nodes that have stencils
std::optional<std::size_t> first_not_finite(const NodeSelection& nodes, std::size_t surface,
                                            std::span<const double> vectors) {
  SurfaceOfNode of(nodes);
  for (std::size_t m = nodes.first_stencil[surface]; m < nodes.first_stencil[surface + 1]; ++m) {
    of.of(m);
    if (!is_finite(&vectors[3 * of.node(m)])) return of.node(m);
  }
  return std::nullopt;
}

/// @throws std::invalid_argument unless both are of as many surfaces, and of as many numbers for each
template <class Others>
void check_alike(const std::string& what, const Others& others, const std::string& than_what,
                 const auto& numbers) {
  if (others.size() != numbers.size()) {
    throw std::invalid_argument("coupler: " + what + " and " + than_what + " of a correction are of " +
                                std::to_string(others.size()) + " and " + std::to_string(numbers.size()) +
                                " surfaces");
  }
  for (std::size_t s = 0; s < numbers.size(); ++s) {
    if (others[s].size() == numbers[s].size()) continue;
    throw std::invalid_argument("coupler: surface " + std::to_string(s) + " has " +
                                std::to_string(numbers[s].size()) + " numbers of " + than_what + ", but " +
                                std::to_string(others[s].size()) + " of " + what);
  }
}

}  // namespace

double tangential_shortfall(const Kernel& kernel) {
  return mean_of_pairs(kernel, [](int distance) { return 0.5 * distance; });
}

TangentialCorrection::TangentialCorrection(const Coupler& coupler, double viscosity)
    : kernel_(coupler.kernel()) {
  if (!(viscosity > 0 && std::isfinite(viscosity))) {
    throw std::invalid_argument("coupler: the viscosity of a tangential correction is " +
                                std::to_string(viscosity) + ", must be positive");
  }
  mobilities_.push_back({1, tangential_shortfall(kernel_) / (viscosity * square_sum(kernel_))});
}

TangentialCorrection::TangentialCorrection(const Coupler& coupler, const Shortfalls& shortfalls)
    : kernel_(coupler.kernel()) {
  if (shortfalls.of_surfaces.empty())
    throw std::invalid_argument("coupler: a tangential correction without a shortfall");
  const double squares = square_sum(kernel_);
  for (const double shortfall : shortfalls.of_surfaces) {
    if (!(shortfall >= 0 && std::isfinite(shortfall))) {
      throw std::invalid_argument("coupler: a shortfall of a tangential correction is " +
                                  std::to_string(shortfall) + ", must not be negative");
    }
    const double half = std::sqrt(shortfall / squares);
    mobilities_.push_back({half, half});
  }
  n_surfaces_ = mobilities_.size() > 1 ? mobilities_.size() : 0;
}

void TangentialCorrection::add(const Coupler& coupler, std::span<const std::span<const double>> normals,
                               std::span<const std::span<const double>> force,
                               std::span<const std::span<double>> velocity) const {
  check_kernel(coupler);
  check_alike("velocity", velocity, "force", force);  // before anything is done
  on_grid_->resize(3 * coupler.grid_nodes().size());
  spread(coupler, normals, force, *on_grid_);
  add_from(coupler, normals, *on_grid_, velocity);
}

void TangentialCorrection::spread(const Coupler& coupler, std::span<const std::span<const double>> normals,
                                  std::span<const std::span<const double>> force,
                                  std::span<double> on_grid) const {
  check(coupler, on_grid.size());
  check_alike("normals", normals, "force", force);
  const auto& transfer = *coupler.implementation_;
  transfer.check_surfaces("correction, force", force);
  if (n_surfaces_ > 0) check_size("correction, shortfalls", n_surfaces_, force.size());
  require_finite(coupler, normals, force);
  transfer.spread(
      With::weights_alone,
      [&](std::size_t surface, std::size_t node, double* result) {
        const Vector along = tangential(&normals[surface][3 * node], &force[surface][3 * node]);
        for (int axis = 0; axis < 3; ++axis) result[axis] = mobility(surface).of_forces * along[axis];
      },
      on_grid);
}

void TangentialCorrection::add_from(const Coupler& coupler, std::span<const std::span<const double>> normals,
                                    std::span<const double> on_grid,
                                    std::span<const std::span<double>> velocity) const {
  check(coupler, on_grid.size());
  check_alike("normals", normals, "velocity", velocity);
  const auto& transfer = *coupler.implementation_;
  transfer.check_surfaces("correction, velocity", velocity);
  if (n_surfaces_ > 0) check_size("correction, shortfalls", n_surfaces_, velocity.size());
  transfer.interpolate(
      With::weights_alone, on_grid, [&](std::size_t surface, std::size_t node, const double* smoothed) {
        const Vector along = tangential(&normals[surface][3 * node], smoothed);
        for (int axis = 0; axis < 3; ++axis)
          velocity[surface][3 * node + axis] += mobility(surface).of_velocities * along[axis];
      });
}

void TangentialCorrection::check(const Coupler& coupler, std::size_t n_on_grid) const {
  check_kernel(coupler);
  check_size("correction, on_grid", n_on_grid, 3 * coupler.grid_nodes().size());
}

void TangentialCorrection::check_kernel(const Coupler& coupler) const {
  if (coupler.kernel().function == kernel_.function) return;
  throw std::invalid_argument("coupler: a correction of kernel '" + kernel_.name + "' with a coupler of '" +
                              coupler.kernel().name + "'");
}

// A node without a triangle has no normal, and one number that is not finite would spoil all around it.
void TangentialCorrection::require_finite(const Coupler& coupler,
                                          std::span<const std::span<const double>> normals,
                                          std::span<const std::span<const double>> force) {
  const auto& transfer = *coupler.implementation_;
  const bool finite = transfer.for_all_nodes([&](std::size_t surface, std::size_t node) {
    return is_finite(&normals[surface][3 * node]) && is_finite(&force[surface][3 * node]);
  });
  if (finite) return;
  const NodeSelection& nodes = transfer.stencils.nodes;
  for (std::size_t s = 0; s < force.size(); ++s) {
    for (const bool of_forces : {false, true}) {
      const auto node = first_not_finite(nodes, s, of_forces ? force[s] : normals[s]);
      if (!node) continue;
      throw CorrectionError(std::string("the ") + (of_forces ? "force" : "normal") + " of node " +
                                std::to_string(*node) + " of surface " + std::to_string(s) + " is not finite",
                            std::uint64_t{s} << 33 | std::uint64_t{of_forces} << 32 | *node);
    }
  }
}

}  // namespace tanktread::coupler
