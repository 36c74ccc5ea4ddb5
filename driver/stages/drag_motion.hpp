// Membranes that move against a drag in place of a fluid.
#pragma once

#include <cstdint>
#include <vector>

#include "driver/packets/packets.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/components.hpp"
#include "driver/units/units.hpp"
#include "membrane/node_drag.hpp"
#include "membrane/strain_rates.hpp"
#include "membrane/surface_check.hpp"

namespace tanktread::driver {

/// The nodes of the membranes of a case under their own forces and loads, each against a drag per area, by
/// explicit steps
///
///     x(t + dt) = x(t) + dt u(t),   (zeta A + B^T B) u = F          (membrane::NodeDrag)
///
/// F are the nodal forces of the membrane with its loads; B^T B is of an implicit viscosity and absent
/// without. Lattice units; steps and velocities are in time steps of the case. The viscosity of an explicit
/// scheme must know how long a step is: `law_step`, which every step then has.
class DragMotion {
 public:
  /// @param drag zeta a/mu_o
  /// @param law_step of explicit schemes, time steps
  DragMotion(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes, double drag,
             double law_step);

  /// The membranes start here and not from their reference: that elements are turned to there is no mistake.
  /// Not for explicit viscosities, which remember strains. settle() is to follow.
  void start_at(const NodeVectors& positions);

  /// Forces and velocities at these positions: once for each, in the order of time.
  /// @param step by which the loads are on or off
  /// @throws membrane::InvertedElement, with bending also by membrane::SurfaceCheck; RunError if the
  /// equations of an implicit viscosity are not solved
  void settle(const NodeVectors& positions, std::int64_t step);

  /// The nodes go on by a step of this length. settle() is to follow. @throws LongMove
  NodeVectors moved(double dt) const;

  /// Estimates the highest rate at which a small disturbance of the present state dies out, per time step of
  /// the case: explicit steps are stable below 2 over it. By power iteration on the forces themselves; it
  /// remembers the disturbance, so that the first call is the longest. From below: the estimate may lack some
  /// parts in a hundred. settle() must have been called. @param step as there
  double highest_rate(std::int64_t step);

  const std::vector<CapsuleMembrane>& membranes() const { return membranes_; }
  const NodeVectors& velocity() const { return velocity_; }
  /// All forces of the membranes: what the drag takes up, zeta A u.
  NodeVectors force() const;

 private:
  /// @param velocity where to begin; overwritten
  membrane::NodeDrag::Solution solve(std::size_t capsule, const Eigen::Matrix3Xd& force, double tolerance,
                                     Eigen::Matrix3Xd& velocity) const;
  std::vector<double> grow_disturbance(const NodeVectors& positions, const NodeVectors& force,
                                       std::int64_t step);

  int most_iterations_;
  std::vector<CapsuleMembrane> membranes_;
  std::vector<CapsuleMembrane> elastic_;  ///< the same without viscosity: forces that no history is in
  std::vector<membrane::NodeDrag> drag_;
  /// Empty for a membrane without bending: its forces know no angles, and it folds as it likes.
  std::vector<std::vector<membrane::SurfaceCheck>> checks_;
  /// What the springs of explicit viscosities add to the forces of a disturbance: B^T B of their moduli.
  /// Empty without.
  std::vector<std::vector<membrane::StrainRates>> springs_;
  NodeVectors velocity_, disturbance_;
  std::vector<double> growth_;  ///< of the disturbance of each capsule, by the last iteration
  bool has_grown_ = false;      ///< the disturbance is one of the fastest by now
};

}  // namespace tanktread::driver
