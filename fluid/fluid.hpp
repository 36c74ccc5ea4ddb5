// The border of the fluid component: what a flow solver offers to the rest of the program.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "fluid/state.hpp"

namespace tanktread::fluid {

/// Number of fluid nodes along x, y, z. Node (i, j, k) sits at (i + 1/2, j + 1/2, k + 1/2) grid steps.
struct GridShape {
  int nx = 0, ny = 0, nz = 0;

  /// Number of nodes.
  std::int64_t size() const { return std::int64_t{nx} * ny * nz; }
  /// Linear index of a node, x fastest: the order of every array that crosses this border (and of VTK).
  std::int64_t index(int x, int y, int z) const { return (std::int64_t{z} * ny + y) * nx + x; }
  bool operator==(const GridShape&) const = default;
};

/// The flow went wrong (NaN, or a speed at or over the limit). The message says what, where and at which
/// step.
class Breakdown : public std::runtime_error {
 public:
  /// @param node where, as an index in the whole box; -1: not known
  explicit Breakdown(const std::string& message, std::int64_t node = -1)
      : std::runtime_error(message), node_(node) {}
  std::int64_t node() const { return node_; }

 private:
  std::int64_t node_;
};

/// A flow solver on a Cartesian grid, in lattice units: grid step = time step = reference density = 1.
///
/// Contract of forces: a force is a force on one node (grid step cubed times force density); add_force adds
/// into the solver's force field; the caller clears it with clear_force() before spreading anew. Nothing
/// outside fluid/ may assume how populations lie in memory, nor that every node's velocity is at hand.
class Fluid {
 public:
  virtual ~Fluid() = default;

  virtual GridShape shape() const = 0;

  /// Velocity u = (sum_i f_i c_i + F/2)/rho (Guo et al. 2002; Eq. 2.46) of the last step done, on the nodes
  /// asked for. It takes F from the force field: ask for it before clear_force() and add_force() change that.
  /// @param nodes linear node indices (GridShape::index)
  /// @param velocity 3 numbers a node asked for, component fastest; overwritten
  /// @throws std::invalid_argument if the sizes do not match or a node lies outside the box
  virtual void velocity(std::span<const std::int64_t> nodes, std::span<double> velocity) const = 0;

  /// What the next step() will meet on the nodes asked for: a force F that is added to a node and is all of
  /// the force field there makes its velocity
  ///   u = velocity + mobility F,   velocity = (sum_i f_i c_i + F_b/2)/rho,   mobility = 1/(2 rho)
  /// of the populations f_i that come in, with the uniform body force F_b (Guo et al. 2002; without inertia
  /// rho = 1). So a force may depend on the velocity of its own time. What the force field holds at present
  /// does not count, and nothing changes.
  /// @param nodes linear node indices (GridShape::index)
  /// @param velocity 3 numbers a node asked for, component fastest; overwritten
  /// @param mobility one number a node asked for; overwritten
  /// @throws std::invalid_argument if the sizes do not match or a node lies outside the box; std::logic_error
  /// of a solver that cannot tell
  virtual void free_velocity(std::span<const std::int64_t> nodes, std::span<double> velocity,
                             std::span<double> mobility) const = 0;

  /// Power that viscosity will take from the flow on every node in the next step(), under the present force
  /// and viscosity: 2 mu S:S, with the rate of strain S (its trace included) that the solver itself has
  /// there. Nothing changes.
  /// @param power size() numbers, force times velocity; overwritten
  /// @throws std::invalid_argument for another number of them; std::logic_error of a solver that cannot tell
  virtual void dissipation(std::span<double> power) const = 0;

  /// Power that moving walls give to the fluid beside every node on the way to the next step(): the sum of
  /// (momentum given).(velocity of the wall) over the links of the node that meet a wall; 0 elsewhere.
  /// Nothing changes.
  /// @param power size() numbers, force times velocity; overwritten
  /// @throws std::invalid_argument for another number of them; std::logic_error of a solver that cannot tell
  virtual void wall_power(std::span<double> power) const = 0;

  /// Density and velocity of every node, for output: size() and 3 size() numbers, overwritten. As velocity().
  virtual void moments(std::span<double> density, std::span<double> velocity) const = 0;

  /// The same of the nodes of some layers: one number and three a node there. A solver that has not its own
  /// way asks moments() for all nodes.
  /// @throws std::invalid_argument if the sizes do not match or a layer lies outside the box
  virtual void moments_of_layers(Layers layers, std::span<double> density, std::span<double> velocity) const;

  /// Adds a force on each node listed (3 numbers a node). A node may be listed more than once.
  /// @throws std::invalid_argument if the sizes do not match or a node lies outside the box
  virtual void add_force(std::span<const std::int64_t> nodes, std::span<const double> force) = 0;

  /// Sets the added force of every node to zero (the uniform body force stays).
  virtual void clear_force() = 0;

  /// The added force of every node (3 size() numbers, component fastest), without the uniform body force.
  virtual std::span<const double> force() const = 0;

  /// Sets the kinematic viscosity of every node: size() numbers, each positive and finite.
  /// @throws std::invalid_argument if their number is another, or naming the first node whose viscosity is
  /// not positive and finite
  virtual void set_viscosity(std::span<const double> kinematic_viscosity) = 0;

  /// Sets the kinematic viscosity of the nodes listed, from the next step() on; the others keep theirs
  /// (before the first call that of the solver's settings). Its work goes with the nodes listed, not with the
  /// box, so it can be called in every step with those that have changed. How nodes are divided among calls
  /// makes no difference to any result, nor does their order; of a node that is listed twice the last one
  /// counts.
  /// @param nodes linear node indices (GridShape::index)
  /// @param kinematic_viscosity one number a node listed, each positive and finite
  /// @throws std::invalid_argument if the sizes do not match, a node lies outside the box or, naming the
  /// node, a viscosity is not positive and finite; nothing is changed then
  virtual void set_viscosity(std::span<const std::int64_t> nodes,
                             std::span<const double> kinematic_viscosity) = 0;

  /// Goes on by one time step with the present force. @return the highest speed met.
  /// @throws Breakdown if a velocity is not finite or a speed is at or over the solver's limit; the state is
  /// then of no use
  virtual double step() = 0;

  /// The whole state, for a checkpoint or another program.
  virtual State state() const = 0;

  /// What state() has, without its numbers; and of one of its arrays the numbers on some layers, bit for bit
  /// those of state(). A solver that has not its own way makes the whole state for that.
  /// @param values `components` numbers a node of the layers; overwritten
  /// @throws std::invalid_argument if there is no such array, the sizes do not match or a layer lies outside
  /// the box
  virtual StateShape state_shape() const;
  virtual void state_of_layers(const std::string& array, Layers layers, std::span<double> values) const;

  /// Takes over a state of a solver with the same settings.
  /// @throws std::invalid_argument naming the array that is missing, unknown or of the wrong size; the solver
  /// then stays as it was
  virtual void restore(const State& state) = 0;

  /// The same from a state in parts. Nothing is changed before StateSource::accepted(): what is thrown until
  /// then (as restore() does, and by the source) leaves the solver as it was. If the source fails afterwards
  /// the state is of no use: restore another before anything else. A solver that has not its own way puts the
  /// state together, and then calls restore().
  virtual void restore_from(const StateSource& state);
};

}  // namespace tanktread::fluid
