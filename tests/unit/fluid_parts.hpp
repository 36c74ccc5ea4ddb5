// A box in parts, and what a part must hold of the whole: shared by tests with and without ranks.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "fluid/halo.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {

/// Where a box is cut along x, y, z: the first node of each part, and the number of nodes after the last.
using Cuts = std::array<std::vector<int>, 3>;

inline int n_parts(const Cuts& cuts) {
  int n = 1;
  for (const auto& along : cuts) n *= static_cast<int>(along.size()) - 1;
  return n;
}

/// Place of a part along x, y, z; parts are numbered along x, then y, then z.
inline std::array<int, 3> place_of(const Cuts& cuts, int part) {
  const int px = static_cast<int>(cuts[0].size()) - 1, py = static_cast<int>(cuts[1].size()) - 1;
  return {part % px, part / px % py, part / px / py};
}

/// The part at a place; places go on round the box.
inline int part_at(const Cuts& cuts, std::array<int, 3> place) {
  int part = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const int n = static_cast<int>(cuts[axis].size()) - 1;
    part = part * n + (place[axis] + n) % n;
  }
  return part;
}

inline int neighbour_of(const Cuts& cuts, int part, const std::array<int, 3>& direction) {
  auto place = place_of(cuts, part);
  for (int axis = 0; axis < 3; ++axis) place[axis] += direction[axis];
  return part_at(cuts, place);
}

inline GridPart part_of(const Cuts& cuts, int part) {
  const auto place = place_of(cuts, part);
  GridPart result;
  std::array<int, 3> n;
  for (int axis = 0; axis < 3; ++axis) {
    result.begin[axis] = cuts[axis][place[axis]];
    n[axis] = cuts[axis][place[axis] + 1] - result.begin[axis];
  }
  result.shape = {n[0], n[1], n[2]};
  return result;
}

/// Nodes of the box, in the order of those of the part.
inline std::vector<std::int64_t> nodes_of(const GridShape& box, const GridPart& part) {
  std::vector<std::int64_t> nodes;
  for_each_node(part.shape, [&](int x, int y, int z, std::int64_t) {
    nodes.push_back(box.index(part.begin[0] + x, part.begin[1] + y, part.begin[2] + z));
  });
  return nodes;
}

/// Of an array of the box, `components` numbers a node, those of some nodes.
inline Numbers taken(const Numbers& of_box, int components, const std::vector<std::int64_t>& nodes) {
  Numbers numbers;
  for (const std::int64_t node : nodes)
    numbers.insert(numbers.end(), &of_box[components * node], &of_box[components * node] + components);
  return numbers;
}

/// What a part has of a state of the box.
inline State taken(State of_box, const std::vector<std::int64_t>& nodes) {
  for (auto& array : of_box.arrays) array.values = taken(array.values, array.components, nodes);
  return of_box;
}

/// Those of a list of nodes of the box that a part has, by its own numbers.
inline NodeForces taken(const NodeForces& of_box, const std::vector<std::int64_t>& nodes) {
  std::map<std::int64_t, std::int64_t> own;
  for (std::size_t k = 0; k < nodes.size(); ++k) own[nodes[k]] = static_cast<std::int64_t>(k);
  NodeForces forces;
  for (std::size_t k = 0; k < of_box.nodes.size(); ++k) {
    const auto found = own.find(of_box.nodes[k]);
    if (found == own.end()) continue;
    forces.nodes.push_back(found->second);
    forces.force.insert(forces.force.end(), &of_box.force[3 * k], &of_box.force[3 * k] + 3);
  }
  return forces;
}

/// Everything that a solver says of some nodes.
struct Said {
  Moments moments;
  Numbers velocity, free_velocity, mobility, dissipation, wall_power;
  bool operator==(const Said& other) const {
    return moments.density == other.moments.density && moments.velocity == other.moments.velocity &&
           velocity == other.velocity && free_velocity == other.free_velocity && mobility == other.mobility &&
           dissipation == other.dissipation && wall_power == other.wall_power;
  }
};
inline Said said(const Fluid& fluid) {
  const auto nodes = all_nodes(fluid.shape());
  const std::size_t n = nodes.size();
  Said said{moments(fluid), Numbers(3 * n), Numbers(3 * n), Numbers(n), Numbers(n), wall_power(fluid)};
  fluid.velocity(nodes, said.velocity);
  fluid.free_velocity(nodes, said.free_velocity, said.mobility);
  fluid.dissipation(said.dissipation);
  return said;
}
inline Said taken(const Said& of_box, const std::vector<std::int64_t>& nodes) {
  return {{taken(of_box.moments.density, 1, nodes), taken(of_box.moments.velocity, 3, nodes)},
          taken(of_box.velocity, 3, nodes),
          taken(of_box.free_velocity, 3, nodes),
          taken(of_box.mobility, 1, nodes),
          taken(of_box.dissipation, 1, nodes),
          taken(of_box.wall_power, 1, nodes)};
}

}  // namespace tanktread::fluid::test
