#include "driver/packets/packets.hpp"

namespace tanktread::driver {

std::string name_of(Packet packet) {
  switch (packet) {
    case Packet::grid_velocity:
      return "grid_velocity";
    case Packet::node_velocity:
      return "node_velocity";
    case Packet::positions:
      return "positions";
    case Packet::node_force:
      return "node_force";
    case Packet::grid_force:
      return "grid_force";
  }
  return "";
}

std::string array_of(Packet packet) {
  switch (packet) {
    case Packet::grid_velocity:
    case Packet::node_velocity:
      return "velocity";
    case Packet::positions:
      return "";
    case Packet::node_force:
      return "total_force";
    case Packet::grid_force:
      return "force";
  }
  return "";
}

bool is_on_grid(Packet packet) {
  return packet == Packet::grid_velocity || packet == Packet::grid_force;
}

NodeVectors zero_like(const NodeVectors& vectors) {
  NodeVectors zero;
  for (const auto& matrix : vectors) zero.emplace_back(Eigen::Matrix3Xd::Zero(3, matrix.cols()));
  return zero;
}

}  // namespace tanktread::driver
