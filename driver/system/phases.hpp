// The phases of a step, each a function from packet to packet. The run and the single stages call the same
// ones. A run gives them packets that it no longer needs, as `memory`: what they return is written there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/packets/packets.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/node_corrections.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::driver {

/// A membrane node may not move further than this in one step, grid steps: its stencil would leave its force
/// behind.
inline constexpr double longest_move = 0.5;

/// A node would move too far. The message says which capsule, node, place and how far.
class LongMove : public std::runtime_error {
 public:
  LongMove(const std::string& message, std::uint64_t of_precedence)
      : std::runtime_error(message), precedence(of_precedence) {}
  std::uint64_t precedence;  ///< of several, the one with the lowest is of the first capsule and node
};

/// An element of a capsule, which the message names: an InvertedElement of one of several membranes.
class CapsuleInverted : public membrane::InvertedElement {
 public:
  CapsuleInverted(const std::string& message, std::uint64_t of_precedence)
      : membrane::InvertedElement(message), precedence(of_precedence) {}
  std::uint64_t precedence;  ///< of several, the one with the lowest is met first
};

/// The numbers of capsules in the case, where only some of them are given; none: all are, in their order.
using CapsuleNumbers = std::span<const std::size_t>;

/// 1. fluid: the velocity u(t) on the nodes listed (Eq. 2.46).
GridVectors grid_velocity(const fluid::Fluid& fluid, NodeList nodes, GridVectors memory = {});

/// Builds the stencils of the capsules at their positions, with the shear dipoles that they may have: for the
/// spread there, and for the interpolation of the next step.
/// @param triangles of the capsules, for the normals @throws coupler::StencilError
void build_stencils(coupler::Coupler& coupler, const NodeCorrections& corrections,
                    const NodeVectors& positions, const std::vector<Eigen::Matrix3Xi>& triangles);

/// 2. coupler: the velocity u_m(t) of the nodes (Eq. 2.3), with the stencils at x(t):
/// interpolated_velocity(), then correct_velocity(). Parameters and exceptions as there.
NodeVectors velocity_of_nodes(const coupler::Coupler& coupler, const NodeCorrections& corrections,
                              const GridVectors& velocity, const Surfaces& surfaces,
                              const NodeVectors& force);

/// The first part of 2.: what the stencils at x(t) find.
/// @param velocity on all nodes that the stencils touch, or more
/// @param positions x(t), for their number
/// @throws std::invalid_argument if a node that a stencil touches is missing
NodeVectors interpolated_velocity(const coupler::Coupler& coupler, const GridVectors& velocity,
                                  const NodeVectors& positions, NodeVectors memory = {});

/// The second part of 2.: adds what a kernel takes off the velocity along the surfaces (docs/kernels.md) if
/// that is to be given back; then, if it is to be kept, the volume of each surface is that of x(t) after the
/// move.
/// @param surfaces at x(t)
/// @param force F_m(t), looked at for the correction along the surfaces only
/// @throws coupler::CorrectionError
void correct_velocity(const coupler::Coupler& coupler, const NodeCorrections& corrections,
                      const Surfaces& surfaces, const NodeVectors& force, NodeVectors& velocity);

/// 3. membrane: positions x(t+1) = x(t) + u_m(t) (Eq. 2.19). @throws LongMove, also for not a number
NodeVectors move_nodes(const NodeVectors& positions, const NodeVectors& velocity, int threads = 1,
                       NodeVectors memory = {}, CapsuleNumbers numbers = {});

/// 4. membrane: takes the positions x(t+1); strain, stress with its history, total nodal forces F_m(t+1),
/// those of a load included, but for implicit viscous forces. Implicit viscosities stand at x(t+1) then,
/// their stresses are still those of t.
/// @param velocity u_m(t), which moved the nodes there
/// @param step of the positions, t+1
/// @throws CapsuleInverted; RunError if a program in the place of a membrane gives no forces
NodeVectors nodal_forces(std::vector<CapsuleMembrane>& membranes, const NodeVectors& positions,
                         const NodeVectors& velocity, std::int64_t step, NodeVectors memory = {},
                         CapsuleNumbers numbers = {});

/// The implicit viscous forces of a motion that is given, added: s(t+1) = (B u + theta s(t))/(1 + theta)
/// (ImplicitViscosity) with the velocity u of the nodes at x(t+1). @throws membrane::InvertedElement
void add_viscous_forces_of(std::vector<CapsuleMembrane>& membranes, const NodeVectors& velocity,
                           NodeVectors& force);

/// Whether any of the membranes has an implicit viscosity.
bool any_implicit(const std::vector<CapsuleMembrane>& membranes);

/// 6. fluid: the velocity that it will have at t+1 if no force is added, and the mobility, on the nodes
/// listed.
GridVectors free_velocity(const fluid::Fluid& fluid, NodeList nodes, GridVectors memory = {});

/// 5. and 7. coupler: stencils at x(t+1), and the grid force F(t+1) spread with them (Eq. 2.1):
/// build_stencils(), then spread_force(). @throws coupler::StencilError
GridVectors spread(coupler::Coupler& coupler, const NodeCorrections& corrections,
                   const NodeVectors& positions, const std::vector<Eigen::Matrix3Xi>& triangles,
                   const NodeVectors& force);

/// The second of these, with the stencils as they are.
GridVectors spread_force(const coupler::Coupler& coupler, const NodeVectors& force, GridVectors memory = {});

/// fluid: nodes that have come into a capsule, or out of one, take its viscosity.
/// @param of_marks viscosities_of_marks()
void set_viscosity(fluid::Fluid& fluid, const GridMarks& marks, std::span<const double> of_marks);

/// 9. fluid: streams to t+1 and collides under F(t+1): set_force(), then the fluid's step.
/// @return the highest speed. @throws fluid::Breakdown
double advance_fluid(fluid::Fluid& fluid, const GridVectors& force);

/// The first part of 9.: the force of before is replaced.
void set_force(fluid::Fluid& fluid, const GridVectors& force);

/// The positions of all membranes.
NodeVectors positions_of(const std::vector<CapsuleMembrane>& membranes);

/// Positions and triangles of all membranes. @param memory the surfaces of the same membranes before, or none
Surfaces surfaces_now(const std::vector<CapsuleMembrane>& membranes, int threads, Surfaces memory);

}  // namespace tanktread::driver
