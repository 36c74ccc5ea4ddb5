// What crosses the borders between the components in a step, in memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tanktread::driver {

/// Nodes of the grid by their linear indices, x fastest, ascending. A list is never changed: packets on the
/// same nodes share it.
using NodeList = std::shared_ptr<const std::vector<std::int64_t>>;

/// Vectors on some nodes of the grid.
struct GridVectors {
  NodeList nodes = std::make_shared<const std::vector<std::int64_t>>();
  std::vector<double> values;  ///< 3 a node listed, component fastest
  /// Of Packet::free_velocity alone, one a node listed: what a force on the node adds to its velocity.
  std::vector<double> mobility = {};
};

/// Whether vectors are on these nodes and no others.
bool are_on(const GridVectors& vectors, const NodeList& nodes);
/// The vectors on the nodes asked for, of vectors on these or more.
/// @throws std::invalid_argument if one is missing, naming `what` is
GridVectors on_nodes(const GridVectors& vectors, const NodeList& nodes, const std::string& what);

/// In which capsule some nodes of the grid lie.
struct GridMarks {
  NodeList nodes = std::make_shared<const std::vector<std::int64_t>>();
  std::vector<std::int32_t>
      capsule;  ///< one a node listed: 0 outside of all, else the number of the capsule + 1
};

/// A vector on each node of each capsule: a 3 x n matrix a capsule.
using NodeVectors = std::vector<Eigen::Matrix3Xd>;

/// Zero on each node of capsules like those given.
NodeVectors zero_like(const NodeVectors& vectors);

/// The surfaces that vectors are on.
struct Surfaces {
  NodeVectors positions;                    ///< grid steps
  std::vector<Eigen::Matrix3Xi> triangles;  ///< corners, counted within the capsule
};

/// The packets of the step from t to t+1, in their order. Some pass only where a membrane has an implicit
/// viscosity, or the fluid in a capsule another one than outside.
enum class Packet {
  grid_velocity,   ///< u(t) on the grid nodes that the stencils at x(t) touch: fluid to coupler
  node_velocity,   ///< u_m(t): coupler to membrane
  positions,       ///< x(t+1): membrane, from the move to the forces
  explicit_force,  ///< F_m(t+1) without implicit viscous forces: membrane to the solution of those
  free_velocity,   ///< u(t+1) without F(t+1), and the mobility, on the nodes that the stencils at x(t+1)
                   ///< touch: fluid to the same
  node_force,      ///< F_m(t+1): membrane to coupler
  grid_force,      ///< F(t+1) on the nodes that the stencils at x(t+1) touch: coupler to fluid
  inside,          ///< the nodes that have come into a capsule, or out of one, by x(t+1): coupler to fluid
};

/// All packets, in the order of the step.
inline constexpr Packet all_packets[] = {Packet::grid_velocity,  Packet::node_velocity, Packet::positions,
                                         Packet::explicit_force, Packet::free_velocity, Packet::node_force,
                                         Packet::grid_force,     Packet::inside};
/// Whether a packet passes only where a membrane has an implicit viscosity.
bool is_of_implicit(Packet packet);
/// Whether a packet passes only where the fluid in a capsule has another viscosity.
bool is_of_contrast(Packet packet);

/// The name in files and folders, "grid_velocity" ...
std::string name_of(Packet packet);
/// The array that holds the packet in its file: "velocity", "force" (on the grid), "total_force" (on nodes),
/// "inside"; "" for the positions, which are the points.
std::string array_of(Packet packet);
/// Whether the packet lives on the grid (.vti) or on the capsules (.vtu).
bool is_on_grid(Packet packet);

}  // namespace tanktread::driver
