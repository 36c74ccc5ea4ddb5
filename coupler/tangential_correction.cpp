#include "coupler/tangential_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

/// A node without a triangle has no normal, and one number that is not finite would spoil all around it.
void require_finite(const std::string& what, std::size_t surface, std::span<const double> numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (std::isfinite(numbers[k])) continue;
    throw CorrectionError("the " + what + " of node " + std::to_string(k / 3) + " of surface " +
                          std::to_string(surface) + " is not finite");
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
  if (coupler.kernel().function != kernel_.function) {
    throw std::invalid_argument("coupler: a correction of kernel '" + kernel_.name + "' with a coupler of '" +
                                coupler.kernel().name + "'");
  }
  if (normals.size() != force.size() || velocity.size() != force.size()) {
    throw std::invalid_argument("coupler: normals, forces and velocities of a correction are of " +
                                std::to_string(normals.size()) + ", " + std::to_string(force.size()) +
                                " and " + std::to_string(velocity.size()) + " surfaces");
  }
  for (std::size_t s = 0; s < force.size(); ++s) {
    if (normals[s].size() == force[s].size() && velocity[s].size() == force[s].size()) continue;
    throw std::invalid_argument("coupler: surface " + std::to_string(s) + " has " +
                                std::to_string(force[s].size()) + " numbers of force, but " +
                                std::to_string(normals[s].size()) + " of normals and " +
                                std::to_string(velocity[s].size()) + " of velocity");
  }
  const auto& transfer = *coupler.implementation_;
  transfer.check_surfaces("correction, force", force);
  if (n_surfaces_ > 0) check_size("correction, shortfalls", n_surfaces_, force.size());
  const bool finite = transfer.for_all_nodes([&](std::size_t surface, std::size_t node) {
    return is_finite(&normals[surface][3 * node]) && is_finite(&force[surface][3 * node]);
  });
  if (!finite) {
    for (std::size_t s = 0; s < force.size(); ++s) {
      require_finite("normal", s, normals[s]);
      require_finite("force", s, force[s]);
    }
  }
  auto& on_grid = *on_grid_;
  on_grid.resize(3 * coupler.grid_nodes().size());
  transfer.spread(
      With::weights_alone,
      [&](std::size_t surface, std::size_t node, double* result) {
        const Vector along = tangential(&normals[surface][3 * node], &force[surface][3 * node]);
        for (int axis = 0; axis < 3; ++axis) result[axis] = mobility(surface).of_forces * along[axis];
      },
      on_grid);
  transfer.interpolate(
      With::weights_alone, on_grid, [&](std::size_t surface, std::size_t node, const double* smoothed) {
        const Vector along = tangential(&normals[surface][3 * node], smoothed);
        for (int axis = 0; axis < 3; ++axis)
          velocity[surface][3 * node + axis] += mobility(surface).of_velocities * along[axis];
      });
}

}  // namespace tanktread::coupler
