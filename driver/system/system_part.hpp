// What one rank has of a system that several share, and its time step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupler/inside.hpp"
#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/capsule_messages.hpp"
#include "driver/system/first_error.hpp"
#include "driver/system/node_corrections.hpp"
#include "driver/system/region_halo.hpp"
#include "driver/system/system.hpp"
#include "driver/units/units.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// A capsule as it goes to the rank that computes it, and comes back.
struct CapsuleState {
  std::size_t number = 0;  ///< in the case
  Eigen::Matrix3Xd positions, velocity, force;
  std::vector<double> history;  ///< MembraneState::history
};

/// How a step ended.
struct PartStep {
  std::optional<StepError> error;  ///< the first of this rank
  bool all_well = true;            ///< on all ranks
  double highest_speed = 0;        ///< of all ranks
  int viscous_iterations = 0;
};

/// A block of the fluid, the coupler there, and the membranes of some capsules, with what is near to the
/// block of the others. A node's velocity is interpolated by the rank that has its grid cell, a grid node's
/// force is summed by the rank that has it, in the order of capsules and nodes, and a capsule is moved and
/// strained by its owner: no sum is divided, so that results are those of one rank to the last bit. All ranks
/// call its functions together.
class SystemPart {
 public:
  /// World and fluid (the rank's part) are borrowed.
  SystemPart(const ranks::World& world, const ranks::Division& division, fluid::Fluid& fluid,
             const Case& the_case, const Parameters& parameters);
  ~SystemPart();

  /// Takes over capsules at time t = `step`, in the place of those that it owns. Together.
  /// @param shapes that the membranes are made from, in the order of the states
  void take(std::int64_t step, const std::vector<CapsuleState>& states, const MembraneShapes& shapes);

  /// The capsules that it owns.
  std::vector<CapsuleState> states() const;

  /// From t to t+1, as advance() of a whole system. Together.
  PartStep advance();

  /// Marks of the nodes of the block; empty: the fluid has one viscosity.
  std::span<const std::int32_t> marks() const {
    return inside_ ? inside_->marks() : std::span<const std::int32_t>();
  }

  /// Seconds of this rank's steps.
  const StepSeconds& seconds() const { return seconds_; }

 private:
  class Mobility;

  void find_stencils();
  void mark_inside(bool anew);
  void advance_phases(FirstError& error, PartStep& result);
  void find_node_velocities(FirstError& error);
  void move_membranes(FirstError& error);
  void add_implicit(FirstError& error, PartStep& result);
  void force_fluid();
  void bring_velocities(NodeVectors& velocity);
  void correct_along_membranes(FirstError& error, const NodeVectors& force, NodeVectors& velocity);

  const ranks::World& world_;
  fluid::Fluid& fluid_;
  Case case_;
  Parameters parameters_;
  coupler::Coupler coupler_;
  NodeCorrections corrections_;
  std::unique_ptr<coupler::InsideMarks> inside_;  ///< null: the fluid has one viscosity
  std::vector<double> viscosity_of_marks_;
  ImplicitSettings implicit_;
  bool is_implicit_;  ///< any capsule of the case, whoever owns it
  int threads_;

  CapsuleMessages messages_;
  RegionHalo halo_;
  OwnCapsules own_;
  std::vector<CapsuleMembrane> membranes_;
  NearCapsules near_;
  std::vector<std::size_t> order_;  ///< where the number of each capsule stands among those of all ranks
  std::int64_t step_ = 0;
  StepSeconds seconds_;
  // Scratch, one a grid node of the list, or of the rank's own among them.
  std::vector<double> on_grid_, of_own_;
  GridVectors free_;
  NodeVectors scratch_, scratch_force_;  // arrays of before, whose memory the next ones take
};

}  // namespace tanktread::driver
