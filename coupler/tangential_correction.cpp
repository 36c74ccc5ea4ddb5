#include "coupler/tangential_correction.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/surface_check.hpp"

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

double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Takes the parts along the normals off `vectors`.
void keep_tangential(std::span<const double> normals, std::span<double> vectors) {
  for (std::size_t k = 0; k < vectors.size(); k += 3) {
    const double along = dot(&normals[k], &vectors[k]);
    for (int axis = 0; axis < 3; ++axis) vectors[k + axis] -= along * normals[k + axis];
  }
}

/// Adds to the normal at node `at` that of its triangle with the next two.
void add_normal(std::span<const double> positions, int at, int next, int last, std::span<double> normals) {
  const double *a = &positions[3 * at], *b = &positions[3 * next], *c = &positions[3 * last];
  const double u[] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double weight = 1 / (dot(u, u) * dot(v, v));
  normals[3 * at] += weight * (u[1] * v[2] - u[2] * v[1]);
  normals[3 * at + 1] += weight * (u[2] * v[0] - u[0] * v[2]);
  normals[3 * at + 2] += weight * (u[0] * v[1] - u[1] * v[0]);
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

void node_normals(std::span<const double> positions, std::span<const int> triangles,
                  std::span<double> normals) {
  require_surface(positions.size(), triangles, "normals", normals.size());
  for (double& component : normals) component = 0.0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (int corner = 0; corner < 3; ++corner) {
      add_normal(positions, triangles[t + corner], triangles[t + (corner + 1) % 3],
                 triangles[t + (corner + 2) % 3], normals);
    }
  }
  for (std::size_t k = 0; k < normals.size(); k += 3) {
    const double length = std::sqrt(dot(&normals[k], &normals[k]));
    for (int axis = 0; axis < 3; ++axis) normals[k + axis] /= length;
  }
}

TangentialCorrection::TangentialCorrection(const Coupler& coupler, double viscosity)
    : kernel_(coupler.kernel()),
      mobility_(tangential_shortfall(kernel_) / (viscosity * square_sum(kernel_))) {
  if (!(viscosity > 0 && std::isfinite(viscosity))) {
    throw std::invalid_argument("coupler: the viscosity of a tangential correction is " +
                                std::to_string(viscosity) + ", must be positive");
  }
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
  std::vector<std::vector<double>> along;  // the surfaces: forces, then velocities
  std::vector<std::span<const double>> sources;
  std::vector<std::span<double>> targets;
  for (std::size_t s = 0; s < force.size(); ++s) {
    if (normals[s].size() != force[s].size() || velocity[s].size() != force[s].size()) {
      throw std::invalid_argument("coupler: surface " + std::to_string(s) + " has " +
                                  std::to_string(force[s].size()) + " numbers of force, but " +
                                  std::to_string(normals[s].size()) + " of normals and " +
                                  std::to_string(velocity[s].size()) + " of velocity");
    }
    require_finite("normal", s, normals[s]);
    require_finite("force", s, force[s]);
    along.emplace_back(force[s].begin(), force[s].end());
    keep_tangential(normals[s], along.back());
  }
  for (auto& values : along) sources.emplace_back(values), targets.emplace_back(values);
  std::vector<double> grid_force(3 * coupler.grid_nodes().size());
  coupler.spread(sources, grid_force);
  coupler.interpolate(grid_force, targets);
  for (std::size_t s = 0; s < force.size(); ++s) {
    keep_tangential(normals[s], along[s]);
    for (std::size_t k = 0; k < along[s].size(); ++k) velocity[s][k] += mobility_ * along[s][k];
  }
}

}  // namespace tanktread::coupler
