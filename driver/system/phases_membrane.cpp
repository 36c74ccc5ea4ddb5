#include <fmt/format.h>

#include "driver/system/phases.hpp"

namespace tanktread::driver {

NodeVectors move_nodes(const NodeVectors& positions, const NodeVectors& velocity) {
  NodeVectors moved;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    for (Eigen::Index node = 0; node < velocity[k].cols(); ++node) {
      const double move = velocity[k].col(node).norm();
      if (move <= longest_move) continue;  // so that not a number does not pass
      const Eigen::Vector3d at = positions[k].col(node);
      throw LongMove(fmt::format(
          "node {} of capsule {} at ({:.6g}, {:.6g}, {:.6g}) would move by {:.6g} grid steps; at most "
          "{} are allowed",
          node, k, at[0], at[1], at[2], move, longest_move));
    }
    moved.emplace_back(positions[k] + velocity[k]);
  }
  return moved;
}

NodeVectors nodal_forces(std::vector<CapsuleMembrane>& membranes, const NodeVectors& positions,
                         const NodeVectors& velocity, std::int64_t step) {
  NodeVectors forces(membranes.size());
  std::vector<membrane::MembraneStep> steps;
  for (std::size_t k = 0; k < membranes.size(); ++k)
    steps.push_back(membranes[k].step_to(positions[k], forces[k]));
  membrane::advance(steps);
  for (std::size_t k = 0; k < membranes.size(); ++k)
    if (membranes[k].has_program()) forces[k] = membranes[k].program_forces(velocity[k], step);
  return forces;
}

NodeVectors positions_of(const std::vector<CapsuleMembrane>& membranes) {
  NodeVectors positions;
  for (const auto& membrane : membranes) positions.push_back(membrane.positions());
  return positions;
}

}  // namespace tanktread::driver
