#include "coupler/two_fluids.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/axis_stencil.hpp"

namespace tanktread::coupler {
namespace {

/// The grid nodes along the normal of a surface between nodes 0 and 1, the inside being below; their weights
/// with the dipole.
struct Stencil1d {
  int first = 0, width = 0;
  std::array<double, max_width> weights{};
};

Stencil1d stencil_at(const Kernel& kernel, double place, double dipole_length) {
  Stencil1d stencil;
  stencil.width = width_of(kernel);
  stencil.first = static_cast<int>(std::floor(place - kernel.half_width)) + 1;
  const double distance = stencil.first - place;
  weights_of(kernel, 1, &distance, stencil.weights.data());
  if (dipole_length == 0) return stencil;
  std::array<double, max_width> slopes{};
  slopes_of(kernel, 1, &distance, slopes.data());
  for (int k = 0; k < stencil.width; ++k) stencil.weights[k] += dipole_length * slopes[k];
  return stencil;
}

/// Mean of take(stencil) over the places of a surface between two grid nodes.
template <class Take>
double mean_over_places(const Kernel& kernel, double dipole_length, const Take& take) {
  constexpr int n_phases = 1024;  // midpoints: the kinks of all kernels lie between two
  double sum = 0;
  for (int phase = 0; phase < n_phases; ++phase)
    sum += take(stencil_at(kernel, (phase + 0.5) / n_phases, dipole_length));
  return sum / n_phases;
}

/// Density of r + b along one axis, r of the kernel and b within half a grid step, at (k + 1/2) step, k = 0
/// ...
std::vector<double> density_with_cell(const Kernel& kernel, int cells_a_step) {
  const double step = 1.0 / cells_a_step;
  std::vector<double> density(static_cast<std::size_t>(std::ceil((kernel.half_width + 0.5) * cells_a_step)));
  for (std::size_t k = 0; k < density.size(); ++k) {
    const double place = (static_cast<double>(k) + 0.5) * step;
    for (int j = 0; j <= cells_a_step; ++j) {
      const double end = j == 0 || j == cells_a_step ? 0.5 : 1.0;
      density[k] += end * step * kernel.function(place + j * step - 0.5);
    }
  }
  return density;
}

/// <|r + b|>/4, to 2e-4 by these cells.
double mean_distance(const Kernel& kernel) {
  constexpr int cells_a_step = 24;
  const double step = 1.0 / cells_a_step;
  const auto density = density_with_cell(kernel, cells_a_step);
  double sum = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    for (std::size_t j = 0; j < density.size(); ++j) {
      for (std::size_t k = 0; k < density.size(); ++k) {
        const double x = (static_cast<double>(i) + 0.5) * step, y = (static_cast<double>(j) + 0.5) * step,
                     z = (static_cast<double>(k) + 0.5) * step;
        sum += density[i] * density[j] * density[k] * std::sqrt(x * x + y * y + z * z);
      }
    }
  }
  return 8 * step * step * step * sum / 4;  // eight octants
}

void check(const Kernel& kernel, const SideViscosities& viscosities, double dipole_length) {
  for (const double viscosity : {viscosities.outer, viscosities.inner}) {
    if (viscosity > 0 && std::isfinite(viscosity)) continue;
    throw std::invalid_argument("coupler: the viscosity on a side of a surface is " +
                                std::to_string(viscosity) + ", must be positive");
  }
  if (dipole_length != 0 && kernel.slopes == nullptr) {
    throw std::invalid_argument("coupler: kernel '" + kernel.name +
                                "' has no slopes, which a shear dipole needs");
  }
}

/// The greatest part of a dipole's length with which the shortfall is not negative.
double longest_dipole(const Kernel& kernel, const SideViscosities& viscosities, double length) {
  if (tangential_shortfall(kernel, viscosities, length) >= 0) return length;
  double enough = 0, too_long = 1;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (enough + too_long);
    (tangential_shortfall(kernel, viscosities, middle * length) >= 0 ? enough : too_long) = middle;
  }
  return enough * length;
}

}  // namespace

double dipole_length(const Kernel& kernel, const SideViscosities& viscosities) {
  check(kernel, viscosities, 1);
  const auto [outer, inner] = viscosities;
  if (outer == inner) return 0;
  return longest_dipole(kernel, viscosities, 2 * mean_distance(kernel) * (outer - inner) / (outer + inner));
}

double tangential_shortfall(const Kernel& kernel, const SideViscosities& viscosities, double dipole_length) {
  check(kernel, viscosities, dipole_length);
  // The force 1 goes to the grid nodes, and the outer fluid is at rest far off. From a node to the next the
  // velocity changes by the stress between them over the viscosity, of either node half the way.
  return mean_over_places(kernel, dipole_length, [&](const Stencil1d& stencil) {
    const auto compliance = [&](int node) { return 1 / (node <= 0 ? viscosities.inner : viscosities.outer); };
    double stress = 0, velocity = 0, shortfall = 0;
    for (int k = stencil.width - 1; k >= 0; --k) {
      const int node = stencil.first + k;
      velocity -= stress * 0.5 * (compliance(node) + compliance(node + 1));
      shortfall -= stencil.weights[k] * velocity;
      stress += stencil.weights[k];
    }
    return shortfall;
  });
}

}  // namespace tanktread::coupler
