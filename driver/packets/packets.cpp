#include "driver/packets/packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tanktread::driver {

std::string name_of(Packet packet) {
  switch (packet) {
    case Packet::grid_velocity:
      return "grid_velocity";
    case Packet::node_velocity:
      return "node_velocity";
    case Packet::positions:
      return "positions";
    case Packet::explicit_force:
      return "explicit_force";
    case Packet::free_velocity:
      return "free_velocity";
    case Packet::node_force:
      return "node_force";
    case Packet::grid_force:
      return "grid_force";
    case Packet::inside:
      return "inside";
  }
  return "";
}

std::string array_of(Packet packet) {
  switch (packet) {
    case Packet::grid_velocity:
    case Packet::node_velocity:
    case Packet::free_velocity:
      return "velocity";
    case Packet::positions:
      return "";
    case Packet::explicit_force:
    case Packet::node_force:
      return "total_force";
    case Packet::grid_force:
      return "force";
    case Packet::inside:
      return "inside";
  }
  return "";
}

bool is_on_grid(Packet packet) {
  return packet == Packet::grid_velocity || packet == Packet::free_velocity || packet == Packet::grid_force ||
         packet == Packet::inside;
}

bool is_of_contrast(Packet packet) {
  return packet == Packet::inside;
}

bool is_of_implicit(Packet packet) {
  return packet == Packet::explicit_force || packet == Packet::free_velocity;
}

bool are_on(const GridVectors& vectors, const NodeList& nodes) {
  return vectors.nodes == nodes || *vectors.nodes == *nodes;
}

GridVectors on_nodes(const GridVectors& vectors, const NodeList& nodes, const std::string& what) {
  GridVectors result{nodes, {}};
  result.values.reserve(3 * nodes->size());
  auto found = vectors.nodes->begin();
  for (const auto node : *nodes) {
    found = std::lower_bound(found, vectors.nodes->end(), node);
    if (found == vectors.nodes->end() || *found != node) {
      throw std::invalid_argument(fmt::format("no {} on grid node {}, which a stencil touches", what, node));
    }
    const auto number = found - vectors.nodes->begin();
    result.values.insert(result.values.end(), vectors.values.begin() + 3 * number,
                         vectors.values.begin() + 3 * number + 3);
    if (!vectors.mobility.empty()) result.mobility.push_back(vectors.mobility[number]);
  }
  return result;
}

NodeVectors zero_like(const NodeVectors& vectors) {
  NodeVectors zero;
  for (const auto& matrix : vectors) zero.emplace_back(Eigen::Matrix3Xd::Zero(3, matrix.cols()));
  return zero;
}

}  // namespace tanktread::driver
