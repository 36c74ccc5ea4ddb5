// What the coupler's tests share: surfaces of nodes, fields on the grid, and short ways to call the coupler.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler::test {

using Numbers = std::vector<double>;  ///< 3 numbers a node, component fastest
using Vector = std::array<double, 3>;

inline constexpr double eps = 2.220446049250313e-16;

/// Nodes spread evenly over a sphere, at every phase relative to the grid (a spiral of golden angles).
/// Coordinates are multiples of 2^-20: shifts by whole numbers below 2^32 are then exact.
inline Numbers sphere(int n_nodes, double radius, const Vector& centre) {
  Numbers positions;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < n_nodes; ++k) {
    const double height = 1.0 - (2.0 * k + 1.0) / n_nodes, ring = std::sqrt(1.0 - height * height);
    const Vector direction = {ring * std::cos(golden_angle * k), ring * std::sin(golden_angle * k), height};
    for (int axis = 0; axis < 3; ++axis)
      positions.push_back(std::round((centre[axis] + radius * direction[axis]) * 1048576.0) / 1048576.0);
  }
  return positions;
}

inline Numbers shifted(Numbers positions, int axis, double distance) {
  for (std::size_t k = axis; k < positions.size(); k += 3) positions[k] += distance;
  return positions;
}

/// One array after the other.
inline Numbers joined(const std::vector<Numbers>& arrays) {
  Numbers all;
  for (const auto& array : arrays) all.insert(all.end(), array.begin(), array.end());
  return all;
}

/// Numbers between `low` and `high`, the same in every run.
inline Numbers random_numbers(std::size_t n, double low, double high, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> distribution(low, high);
  Numbers numbers(n);
  for (auto& number : numbers) number = distribution(generator);
  return numbers;
}

inline std::array<int, 3> indices_of(const Grid& grid, std::int64_t node) {
  const std::int64_t nx = grid.nodes[0], ny = grid.nodes[1];
  return {static_cast<int>(node % nx), static_cast<int>(node / nx % ny), static_cast<int>(node / (nx * ny))};
}

/// Position of a grid node (i + 1/2, ...).
inline Vector position_of(const Grid& grid, std::int64_t node) {
  const auto [i, j, k] = indices_of(grid, node);
  return {i + 0.5, j + 0.5, k + 0.5};
}

/// A vector field given by a function of position, on the nodes that the coupler asks for.
template <class Field>
Numbers on_grid_nodes(const Coupler& coupler, const Grid& grid, const Field& field) {
  Numbers values;
  for (const auto node : coupler.grid_nodes()) {
    const Vector value = field(position_of(grid, node));
    values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

/// A field given on all nodes of the grid, on the nodes that the coupler asks for.
inline Numbers picked(const Coupler& coupler, const Numbers& whole_grid) {
  Numbers values;
  for (const auto node : coupler.grid_nodes())
    values.insert(values.end(), &whole_grid[3 * node], &whole_grid[3 * node] + 3);
  return values;
}

/// A grid array of the coupler's nodes, on all nodes of the grid (0 elsewhere).
inline Numbers unpicked(const Coupler& coupler, const Grid& grid, const Numbers& values) {
  Numbers whole_grid(std::size_t{3} * grid.nodes[0] * grid.nodes[1] * grid.nodes[2], 0.0);
  const auto nodes = coupler.grid_nodes();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int component = 0; component < 3; ++component)
      whole_grid[3 * nodes[k] + component] = values[3 * k + component];
  return whole_grid;
}

inline void build(Coupler& coupler, const std::vector<Numbers>& surfaces) {
  const std::vector<std::span<const double>> spans(surfaces.begin(), surfaces.end());
  coupler.build(spans);
}

/// Interpolates to surfaces of the sizes given (in nodes); all node velocities, one surface after the other.
inline Numbers interpolate(const Coupler& coupler, const Numbers& grid_velocity,
                           const std::vector<std::size_t>& sizes) {
  std::size_t total = 0;
  for (const auto size : sizes) total += 3 * size;
  Numbers velocity(total, std::nan(""));  // a number that is not overwritten shows
  std::vector<std::span<double>> spans;
  std::size_t start = 0;
  for (const auto size : sizes) {
    spans.emplace_back(velocity.data() + start, 3 * size);
    start += 3 * size;
  }
  coupler.interpolate(grid_velocity, spans);
  return velocity;
}

inline Numbers spread(const Coupler& coupler, const std::vector<Numbers>& forces) {
  Numbers grid_force(3 * coupler.grid_nodes().size(), std::nan(""));
  const std::vector<std::span<const double>> spans(forces.begin(), forces.end());
  coupler.spread(spans, grid_force);
  return grid_force;
}

inline double dot(const Numbers& a, const Numbers& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// The message of the std::invalid_argument that a call throws; "" if it throws none.
template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace tanktread::coupler::test

namespace tanktread::coupler {

/// How GoogleTest prints a parameter.
inline void PrintTo(const Kernel& kernel, std::ostream* out) {
  *out << kernel.name;
}

}  // namespace tanktread::coupler
