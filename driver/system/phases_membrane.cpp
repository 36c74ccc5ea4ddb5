#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "driver/system/membrane_files.hpp"
#include "driver/system/node_ranges.hpp"
#include "driver/system/phases.hpp"

namespace tanktread::driver {
namespace {

/// Not a number does not pass.
bool moves_too_far(const Eigen::Vector3d& velocity) {
  return !(velocity.norm() <= longest_move);
}

[[noreturn]] void refuse_move(std::size_t capsule, Eigen::Index node, const Eigen::Vector3d& at,
                              const Eigen::Vector3d& velocity) {
  throw LongMove(
      fmt::format(
          "node {} of capsule {} at ({:.6g}, {:.6g}, {:.6g}) would move by {:.6g} grid steps; at most {} are "
          "allowed",
          node, capsule, at[0], at[1], at[2], velocity.norm(), longest_move),
      (std::uint64_t{capsule} << 32) + static_cast<std::uint64_t>(node));
}

std::size_t number_of(std::size_t k, CapsuleNumbers numbers) {
  return numbers.empty() ? k : numbers[k];
}

/// All elements are looked at before the first implicit viscosity is.
enum class Met : std::uint64_t { in_elements, in_implicit_viscosity };

/// @param k of the capsules given
[[noreturn]] void refuse_element(Met met, const char* what, std::size_t k, CapsuleNumbers numbers) {
  const auto capsule = number_of(k, numbers);
  throw CapsuleInverted(fmt::format("capsule {}: {}", capsule, what),
                        (static_cast<std::uint64_t>(met) << 32) + capsule);
}

void advance_all(const std::vector<membrane::MembraneStep>& steps, CapsuleNumbers numbers) {
  try {
    membrane::advance(steps);
  } catch (const membrane::InvertedElement& error) {
    refuse_element(Met::in_elements, error.what(), error.membrane(), numbers);
  }
}

/// An implicit viscosity follows its membrane.
void move_implicit(CapsuleMembrane& membrane, std::size_t k, CapsuleNumbers numbers) {
  auto* viscosity = membrane.implicit_viscosity();
  if (viscosity == nullptr) return;
  try {
    viscosity->set_positions(membrane.positions());
  } catch (const membrane::InvertedElement& error) {
    refuse_element(Met::in_implicit_viscosity, error.what(), k, numbers);
  }
}

}  // namespace

NodeVectors move_nodes(const NodeVectors& positions, const NodeVectors& velocity, int threads,
                       NodeVectors memory, CapsuleNumbers numbers) {
  resize_like(positions, memory);
  std::atomic<bool> too_far = false;
  share_out_nodes(positions, threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index node = begin; node < end; ++node) {
      memory[k].col(node) = positions[k].col(node) + velocity[k].col(node);
      if (moves_too_far(velocity[k].col(node))) too_far = true;
    }
  });
  if (!too_far) return memory;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    for (Eigen::Index node = 0; node < positions[k].cols(); ++node) {
      if (moves_too_far(velocity[k].col(node)))
        refuse_move(number_of(k, numbers), node, positions[k].col(node), velocity[k].col(node));
    }
  }
  return memory;
}

NodeVectors nodal_forces(std::vector<CapsuleMembrane>& membranes, const NodeVectors& positions,
                         const NodeVectors& velocity, std::int64_t step, NodeVectors memory,
                         CapsuleNumbers numbers) {
  NodeVectors forces = std::move(memory);
  forces.resize(membranes.size());
  std::vector<membrane::MembraneStep> steps;
  for (std::size_t k = 0; k < membranes.size(); ++k)
    steps.push_back(membranes[k].step_to(positions[k], forces[k]));
  advance_all(steps, numbers);
  for (std::size_t k = 0; k < membranes.size(); ++k) move_implicit(membranes[k], k, numbers);
  for (std::size_t k = 0; k < membranes.size(); ++k)
    if (membranes[k].has_program()) forces[k] = membranes[k].program_forces(velocity[k], step);
  for (std::size_t k = 0; k < membranes.size(); ++k) membranes[k].add_load(step, forces[k]);
  return forces;
}

void add_viscous_forces_of(std::vector<CapsuleMembrane>& membranes, const NodeVectors& velocity,
                           NodeVectors& force) {
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    auto* viscosity = membranes[k].implicit_viscosity();
    if (viscosity == nullptr) continue;
    viscosity->accept(viscosity->stress_of(velocity[k]));
    Eigen::Matrix3Xd viscous(3, force[k].cols());
    viscosity->rates().multiply_transposed(viscosity->stress(), viscous);
    force[k] -= viscous;
  }
}

bool any_implicit(const std::vector<CapsuleMembrane>& membranes) {
  return std::ranges::any_of(
      membranes, [](const CapsuleMembrane& membrane) { return membrane.implicit_viscosity() != nullptr; });
}

NodeVectors positions_of(const std::vector<CapsuleMembrane>& membranes) {
  NodeVectors positions;
  for (const auto& membrane : membranes) positions.push_back(membrane.positions());
  return positions;
}

Surfaces surfaces_now(const std::vector<CapsuleMembrane>& membranes, int threads, Surfaces memory) {
  if (memory.triangles.size() != membranes.size()) return surfaces_of(membranes);
  share_out_nodes(memory.positions, threads, [&](std::size_t k, Eigen::Index begin, Eigen::Index end) {
    memory.positions[k].middleCols(begin, end - begin) =
        membranes[k].positions().middleCols(begin, end - begin);
  });
  return memory;
}

}  // namespace tanktread::driver
