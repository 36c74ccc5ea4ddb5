// What the fluid's tests share: flows to start from, and ways to look at a solver through its border only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "fluid/d3q19.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid::test {

using Numbers = std::vector<double>;
using Vector = std::array<double, 3>;

inline constexpr double eps = std::numeric_limits<double>::epsilon();

/// The list that tests of the fast solver run over, and what a number of its lattice resolves.
inline constexpr Storage storages[] = {Storage::double_precision, Storage::single_precision};
inline double epsilon(Storage storage) {
  return storage == Storage::double_precision ? eps : double{std::numeric_limits<float>::epsilon()};
}
inline std::string name_of(Storage storage) {
  return storage == Storage::double_precision ? "double" : "single";
}

inline constexpr int n_populations = d3q19::n_directions;

/// Density (1 a node) and velocity (3 a node) of every node.
struct Moments {
  Numbers density, velocity;
};
inline Moments moments(const Fluid& fluid) {
  const auto n = static_cast<std::size_t>(fluid.shape().size());
  Moments moments{Numbers(n), Numbers(3 * n)};
  fluid.moments(moments.density, moments.velocity);
  return moments;
}

/// Of every node.
inline Numbers wall_power(const Fluid& fluid) {
  Numbers power(static_cast<std::size_t>(fluid.shape().size()), std::numeric_limits<double>::quiet_NaN());
  fluid.wall_power(power);
  return power;
}
inline double sum_of_wall_power(const Fluid& fluid) {
  const auto power = wall_power(fluid);
  return std::accumulate(power.begin(), power.end(), 0.0);
}

inline const Numbers& array(const State& state, const std::string& name) {
  return std::find_if(state.arrays.begin(), state.arrays.end(),
                      [&](const StateArray& candidate) { return candidate.name == name; })
      ->values;
}
inline Numbers populations(const Fluid& fluid) {
  return array(fluid.state(), "populations");
}

inline double largest(const Numbers& numbers) {
  double largest = 0.0;
  for (const double number : numbers) largest = std::max(largest, std::abs(number));
  return largest;
}

/// What differs between two states, to the last bit: empty if nothing does.
inline std::string difference(const State& a, const State& b) {
  if (a.step != b.step) return "step";
  if (a.arrays.size() != b.arrays.size()) return "number of arrays";
  for (std::size_t k = 0; k < a.arrays.size(); ++k) {
    const auto &left = a.arrays[k], &right = b.arrays[k];
    if (left.name != right.name || left.components != right.components ||
        left.values.size() != right.values.size()) {
      return "shape of " + left.name;
    }
    if (std::memcmp(left.values.data(), right.values.data(), sizeof(double) * left.values.size()) != 0) {
      for (std::size_t i = 0; i < left.values.size(); ++i)
        if (std::bit_cast<std::uint64_t>(left.values[i]) != std::bit_cast<std::uint64_t>(right.values[i]))
          return left.name + "[" + std::to_string(i) + "]";
    }
  }
  return "";
}

/// Calls body(x, y, z, linear index) for every node.
inline void for_each_node(const GridShape& shape,
                          const std::function<void(int, int, int, std::int64_t)>& body) {
  for (int z = 0; z < shape.nz; ++z)
    for (int y = 0; y < shape.ny; ++y)
      for (int x = 0; x < shape.nx; ++x) body(x, y, z, shape.index(x, y, z));
}

inline std::vector<std::int64_t> all_nodes(const GridShape& shape) {
  std::vector<std::int64_t> nodes(shape.size());
  for (std::int64_t node = 0; node < shape.size(); ++node) nodes[node] = node;
  return nodes;
}

/// `n` numbers spread evenly over [-amplitude, amplitude], always the same for one seed.
inline Numbers random_numbers(std::size_t n, double amplitude, unsigned seed) {
  std::mt19937_64 generator(seed);
  Numbers numbers(n);
  for (auto& number : numbers)  // 53 bits of the generator: alike on every standard library
    number = amplitude * (2.0 * static_cast<double>(generator() >> 11) / 9007199254740992.0 - 1.0);
  return numbers;
}

/// A wild flow: every population off its weight by up to `amplitude` times the weight. At 0.1 the speed
/// reaches about 0.03 and the density differs from 1 by about 0.03.
inline void disturb(Fluid& fluid, double amplitude = 0.1, unsigned seed = 1) {
  State state = fluid.state();
  for (auto& array : state.arrays) {
    if (array.name != "populations") continue;
    array.values = random_numbers(array.values.size(), amplitude, seed);
    for (std::size_t k = 0; k < array.values.size(); ++k)
      array.values[k] *= d3q19::weight(static_cast<int>(k % n_populations));
  }
  fluid.restore(state);
}

/// A kinematic viscosity of its own for every node, between 0.02 and 0.4 (tau+ 0.56 to 1.7).
inline Numbers random_viscosity(const GridShape& shape, unsigned seed = 2) {
  Numbers viscosity = random_numbers(shape.size(), 0.19, seed);
  for (auto& value : viscosity) value += 0.21;
  return viscosity;
}

/// Nodes of a few rows (every third node of the box's upper half), and a force of up to 1e-3 for each.
struct NodeForces {
  std::vector<std::int64_t> nodes;
  Numbers force;
};
inline NodeForces some_forces(const GridShape& shape, unsigned seed = 3) {
  NodeForces forces;
  for (std::int64_t node = shape.size() / 2; node < shape.size(); node += 3) {
    const std::int64_t row = node / shape.nx, pack = node % shape.nx / 8;
    if ((row + pack) % 2 == 0) forces.nodes.push_back(node);
  }
  forces.force = random_numbers(3 * forces.nodes.size(), 1e-3, seed);
  return forces;
}

/// A wall pair across `axis` that moves along both of the other axes.
inline WallPair moving_walls(int axis) {
  WallPair walls;
  walls.axis = axis;
  walls.low_velocity[(axis + 1) % 3] = -0.04;
  walls.low_velocity[(axis + 2) % 3] = 0.01;
  walls.high_velocity[(axis + 1) % 3] = 0.03;
  walls.high_velocity[(axis + 2) % 3] = -0.02;
  return walls;
}

/// A box of n nodes between walls across `axis`, as small as can be along the others.
inline GridShape channel(int axis, int n) {
  std::array<int, 3> nodes = {3, 1, 1};
  nodes[axis] = n;
  return {nodes[0], nodes[1], nodes[2]};
}

inline void steps(Fluid& fluid, int n_steps) {
  for (int step = 0; step < n_steps; ++step) fluid.step();
}

}  // namespace tanktread::fluid::test
