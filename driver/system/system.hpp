// The three components of a case, put together, and the arrays that pass between them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/coupler.hpp"
#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/packets/packets.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/implicit_forces.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/node_corrections.hpp"
#include "driver/units/units.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::driver {

/// Seconds of wall clock that the parts of the steps have taken.
struct StepSeconds {
  double fluid = 0;         ///< the fluid's own step, with the forces that it collides under
  double forced_nodes = 0;  ///< velocities taken from the nodes around membranes, forces given to them
  double stencils = 0, interpolation = 0, spreading = 0;
  double correction = 0;  ///< of the interpolated velocity: along the membrane, and for the volume
  double membranes = 0;   ///< moving the nodes, strain, stress, nodal forces
  double inside = 0;      ///< marking the nodes inside capsules, and their viscosity
  double implicit = 0;    ///< implicit viscous forces, with the free velocities taken for them
  double messages = 0;    ///< to and from other ranks but for the fluid's, with what is waited for them
};

/// Packets of the step before, whose memory the next step writes to: fresh memory costs more than what is
/// written there.
struct StepPackets {
  GridVectors grid_velocity, free_velocity, grid_force;
  Surfaces before;
  NodeVectors positions;
};

class FluidOnRanks;

/// A case at work. Between two steps it stands at time t = `step`: positions x(t), populations after the
/// collision of t with the grid force F(t), stencils at x(t). Node velocities and forces are those of the
/// last step, for output.
struct System {
  std::unique_ptr<fluid::Fluid> fluid;
  std::unique_ptr<coupler::Coupler> coupler;
  NodeCorrections corrections;
  std::vector<CapsuleMembrane> membranes;
  std::unique_ptr<coupler::InsideMarks> inside;  ///< of x(t); null: the fluid has one viscosity
  std::vector<double> viscosity_of_marks;        ///< for these

  ImplicitSettings implicit;  ///< of implicit viscosities, if there are any

  std::int64_t step = 0;
  double shear_rate = 0;       ///< g, for the times in files
  NodeVectors node_velocity;   ///< u_m(t-1), which moved the nodes to x(t)
  NodeVectors node_force;      ///< the total force at x(t)
  double highest_speed = 0;    ///< of the fluid, in the last step
  int viscous_iterations = 0;  ///< for the implicit viscous forces of the last step
  StepSeconds seconds;
  int threads = 1;      ///< OpenMP threads
  StepPackets packets;  ///< for their memory; a step does not go on from what is in there

  double shear_time() const { return static_cast<double>(step) * shear_rate; }
};

/// The flow solver of a case, shared by all ranks. Of the first one, where there are others (other_ranks()).
/// @throws InputError if they cannot share it
std::unique_ptr<FluidOnRanks> make_fluid_on_ranks(const Case& the_case, const FlowParameters& parameters);

/// Who has the fluid of a system of the first of several ranks.
enum class Sharing { all_ranks, alone };

/// Builds the components of a case at its start. @param shapes of its capsules
/// @throws InputError if a mesh lies too near a wall for the kernel
System make_system(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes,
                   Sharing sharing = Sharing::all_ranks);

}  // namespace tanktread::driver
