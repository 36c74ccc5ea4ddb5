// The stages: one component at work by itself, from files to files. What they read and write:
// docs/components.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// `tanktread membrane`: strain, stress, nodal forces and new history of all capsules; without implicit
/// viscous forces, which ImplicitStage adds.
struct MembraneStage {
  Case the_case;
  std::filesystem::path in;     ///< a surface file; "": the start of the case, at rest
  bool move = false;            ///< first moves the nodes by the array `velocity` of `in`
  std::filesystem::path state;  ///< an output of this stage, or membrane.vtu of a checkpoint; "": no history
  std::filesystem::path out;    ///< the surface file to write
};
/// @throws InputError for files that do not fit the case; RunError if a node moves too far or an element
/// turns over
void run_stage(const MembraneStage& stage);

/// `tanktread membrane --motion`: the membrane under a motion that is given, time step by time step. An
/// implicit viscosity takes the velocity of the motion.
struct MotionStage {
  Case the_case;
  std::filesystem::path series;  ///< a .pvd of surfaces, interpolated linearly in time; "": a twist about z
  double twist_amplitude = 0;    ///< A0 of TwistingSphere, radians
  double twist_period = 1;       ///< shear times
  double shear_time = 1;         ///< of the twist: its end; a series ends at its last file
  double every = 0.05;  ///< of the twist: shear times between files; a series has files at its own times
  std::filesystem::path out;  ///< a directory: membrane.pvd and membrane/membrane_STEP.vtu
};
/// @throws as above
void run_stage(const MotionStage& stage);

/// `tanktread membrane drag`: the membranes under their own forces and loads, against a drag in place of a
/// fluid (docs/loads.md).
struct DragStage {
  Case the_case;
  std::filesystem::path in;  ///< a surface file to start from; "": the start of the case
  double drag = 1;           ///< zeta a/mu_o, zeta force times time per length^3
  double step = 0;           ///< shear times; 0: chosen by the highest rate of the membrane
  double shear_time = 0;     ///< the end; 0: run.shear_time
  /// Stops where no node is faster, in radii per shear time, and no load is yet to be switched off; 0: never.
  double still = 0;
  std::filesystem::path out;  ///< a directory: drag.csv, membrane.pvd and membrane/membrane_STEP.vtu
};
/// @throws as above
void run_stage(const DragStage& stage);

/// `tanktread implicit`: the implicit viscous forces, which membrane, coupler and fluid find together.
struct ImplicitStage {
  Case the_case;
  std::filesystem::path in;  ///< an output of the membrane stage: nodes, total_force without them, histories
  std::filesystem::path grid;  ///< free_velocity of the fluid stage: point data velocity and mobility
  std::filesystem::path out;   ///< the surface file to write: `in` with all forces, and new histories
};
/// @throws as above; RunError if the equations are not solved
void run_stage(const ImplicitStage& stage);

/// `tanktread coupler spread`: nodal forces to the grid.
struct SpreadStage {
  Case the_case;
  std::filesystem::path in;   ///< a surface file with point data total_force
  std::filesystem::path out;  ///< the grid file to write, with point data force
};
void run_stage(const SpreadStage& stage);

/// `tanktread coupler mark`: which nodes of the grid are inside which capsule.
struct MarkStage {
  Case the_case;
  std::filesystem::path in;  ///< a surface file
  std::filesystem::path
      out;  ///< the grid file to write, with point data inside: 0, or the capsule's number from 1
};
void run_stage(const MarkStage& stage);

/// `tanktread coupler interpolate`: grid velocities to the nodes.
struct InterpolateStage {
  Case the_case;
  std::filesystem::path in;    ///< a surface file
  std::filesystem::path grid;  ///< a grid file with point data velocity
  std::filesystem::path out;   ///< the surface file to write: `in` with point data velocity
};
void run_stage(const InterpolateStage& stage);

/// `tanktread fluid`: some steps of the flow solver.
struct FluidStage {
  Case the_case;
  std::filesystem::path
      state;  ///< an output of this stage, or a checkpoint's fluid.vti; "": the start of the case
  std::filesystem::path force;  ///< a grid file with point data force, held through all steps; "": none
  /// A grid file with point data inside, by which nodes take the viscosity of a capsule, held as well; "":
  /// the viscosities stay as they are.
  std::filesystem::path inside;
  std::int64_t n_steps = 1;
  std::filesystem::path out;     ///< the state to write
  std::filesystem::path fields;  ///< a grid file with density, velocity, force to write too; "": none
  std::filesystem::path free;    ///< a grid file with the free velocity of the next step, mobility; "": none
};
void run_stage(const FluidStage& stage);

}  // namespace tanktread::driver
