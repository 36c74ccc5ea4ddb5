// What one rank has of a system that several share, and its time step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupler/inside.hpp"
#include "driver/case/case.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/capsule_messages.hpp"
#include "driver/system/capsules_now.hpp"
#include "driver/system/first_error.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/node_corrections.hpp"
#include "driver/system/part_places.hpp"
#include "driver/system/region_halo.hpp"
#include "driver/system/system.hpp"
#include "driver/units/units.hpp"
#include "ranks/division.hpp"
#include "ranks/world.hpp"

namespace tanktread::driver {

/// A capsule as it goes from one rank to another.
struct PartCapsule {
  /// At a time after its start.
  struct State {
    Eigen::Matrix3Xd positions, velocity, force;
    std::vector<double> history;  ///< MembraneState::history
  };

  std::size_t number = 0;        ///< in the case
  membrane::TriangleMesh start;  ///< as MembraneShapes::meshes
  Eigen::Matrix3Xd stress_free;  ///< as there
  std::optional<State> state;    ///< none: it starts, at rest
};

/// The velocities of the nodes of a rank's capsules, u_m(t) at the time t where it stands.
struct NodeVelocities {
  NodeVectors interpolated, corrected;
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
  /// World and fluid (the rank's part) are borrowed. It has no capsules yet.
  SystemPart(const ranks::World& world, const ranks::Division& division, fluid::Fluid& fluid,
             const Case& the_case, const Parameters& parameters);
  ~SystemPart();

  /// Begins at time t = `step`: each capsule goes to the rank that has the middle of its nodes. Together.
  /// @param capsules that this rank knows; of all ranks together each of the case once
  /// @param given_error why this rank does not know all that it should
  /// @return as advance(); a capsule that does not fit its state is an error of phase `restore`
  PartStep begin(std::int64_t step, std::vector<PartCapsule> capsules,
                 const std::optional<StepError>& given_error = std::nullopt);

  /// Gives capsules whose middle has moved to another rank to that one. Together.
  void share_out();

  /// From t to t+1, as advance() of a whole system. Together.
  PartStep advance();

  /// What is read of the capsules that it owns, ascending by their numbers. Borrowed until the next step.
  CapsulesNow capsules() const {
    return {membranes_, own_.velocity, own_.force, own_.numbers, 0, step_, parameters_.shear_rate};
  }
  /// Of all capsules of the case.
  const std::vector<std::int64_t>& n_triangles() const { return n_triangles_; }
  const MembraneArrays& arrays() const { return arrays_; }

  /// The velocities of its nodes now. Together.
  NodeVelocities node_velocities(FirstError& error);

  /// Marks of the nodes of the block at the present positions, also if the fluid has one viscosity.
  /// @throws coupler::InsideError where surfaces overlap, and the fluid has one viscosity
  std::vector<std::int32_t> marks_now();

  /// Marks of the nodes of the block; empty: the fluid has one viscosity.
  std::span<const std::int32_t> marks() const {
    return inside_ ? inside_->marks() : std::span<const std::int32_t>();
  }

  /// Seconds of this rank's steps.
  const StepSeconds& seconds() const { return seconds_; }

  const ranks::World& world() const { return world_; }
  const Case& the_case() const { return case_; }
  const Parameters& parameters() const { return parameters_; }
  int threads() const { return threads_; }

 private:
  class Mobility;

  int owner_of(const Eigen::Matrix3Xd& positions) const;
  std::vector<PartCapsule> brought_to_owners(std::vector<PartCapsule> capsules) const;
  PartCapsule given_away(std::size_t k) const;
  void keep(std::vector<PartCapsule> capsules, FirstError& error);
  void count_capsules();
  PartStep settle(FirstError& error);

  void find_stencils();
  void mark_inside(bool anew);
  void advance_phases(FirstError& error, PartStep& result);
  void interpolate();
  void find_node_velocities(FirstError& error);
  void keep_volume(NodeVectors& velocity) const;
  void move_membranes(FirstError& error);
  void add_implicit(FirstError& error, PartStep& result);
  void force_fluid();
  void bring_velocities(NodeVectors& velocity);
  void correct_along_membranes(FirstError& error, const NodeVectors& force, NodeVectors& velocity);

  const ranks::World& world_;
  fluid::Fluid& fluid_;
  Case case_;
  Parameters parameters_;
  coupler::GridPart part_;
  coupler::Coupler coupler_;
  NodeCorrections corrections_;
  std::unique_ptr<coupler::InsideMarks> inside_;  ///< null: the fluid has one viscosity
  std::vector<double> viscosity_of_marks_;
  ImplicitSettings implicit_;
  bool is_implicit_;  ///< any capsule of the case, whoever owns it
  int threads_;

  PartPlaces places_;
  CapsuleMessages messages_;
  RegionHalo halo_;
  OwnCapsules own_;
  std::vector<CapsuleMembrane> membranes_;
  NearCapsules near_;
  std::vector<std::size_t> order_;  ///< where the number of each capsule stands among those of all ranks
  std::vector<std::int64_t> n_triangles_;  ///< of each capsule of the case
  MembraneArrays arrays_;                  ///< of files of all capsules
  std::int64_t step_ = 0;
  StepSeconds seconds_;
  // Scratch, one a grid node of the list, or of the rank's own among them.
  std::vector<double> on_grid_, of_own_;
  GridVectors free_;
  NodeVectors scratch_, scratch_force_;  // arrays of before, whose memory the next ones take
};

}  // namespace tanktread::driver
