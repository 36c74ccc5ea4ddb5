// The lattice Boltzmann solver: D3Q19, two relaxation times, Guo forcing, half-way moving walls.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "fluid/fluid.hpp"
#include "fluid/halo.hpp"

namespace tanktread::fluid {

/// A pair of parallel walls half a grid step outside the first and the last node of one axis, moving in their
/// planes.
struct WallPair {
  int axis = 2;                                    ///< 0, 1, 2 for x, y, z
  std::array<double, 3> low_velocity = {0, 0, 0};  ///< of the wall at coordinate 0; no component along `axis`
  std::array<double, 3> high_velocity = {0, 0, 0};  ///< of the wall at coordinate n
};

/// What the flow does before the first step.
enum class Start {
  rest,       ///< density 1, velocity 0
  developed,  ///< the steady laminar profile of the walls and the body force (Couette + Poiseuille)
};

/// How populations are kept, as differences from rest: a step moves all of them to and from memory, which is
/// what it takes its time for.
enum class Storage {
  double_precision,
  single_precision,  ///< and the arithmetic of a step; forces, viscosities and all that leaves stay double
};

/// Settings of the solver, all in lattice units.
struct LatticeBoltzmannSettings {
  GridShape shape;                ///< nx >= 3, ny >= 1, nz >= 1
  std::optional<WallPair> walls;  ///< none: periodic on all axes
  double relaxation_time = 1.0;   ///< tau+ = 1/2 + 3 nu, > 1/2
  /// Lambda = (tau+ - 1/2)(tau- - 1/2), held fixed where the viscosity differs; none: single rate, tau- =
  /// tau+.
  std::optional<double> magic_parameter = 3.0 / 16.0;
  bool inertia = true;  ///< false drops the quadratic terms of equilibrium and force (Stokes)
  std::array<double, 3> body_force = {0, 0, 0};  ///< uniform, on each node
  Start start = Start::rest;
  Storage storage = Storage::double_precision;
  double speed_limit = 0.3;  ///< a speed at or over it is a Breakdown
  int threads = 0;  ///< 0: as many as OpenMP offers. The result does not depend on it, to the last bit.
};

/// D3Q19 with two relaxation times (Ginzburg) and the body force of Guo et al. 2002 split in its even and odd
/// part:
///
///   f_i* = f_i - w+ (f_i^+ - f_i^eq+) - w- (f_i^- - f_i^eq-) + (1 - w+/2) F_i^+ + (1 - w-/2) F_i^-,   w± =
///   1/tau±
///
/// Populations are kept as their difference from rest (f_i - w_i), which saves digits, in one array that is
/// updated in place by turns (AA pattern; Bailey et al. 2009, doi 10.1109/ICPP.2009.38): 2 x 19 numbers move
/// a node and step.
/// The state's arrays are "populations" (19 a node: what goes out after the last collision, less the
/// weights), "force" (3) and, after set_viscosity(), "viscosity" (1).
/// @throws std::invalid_argument naming the setting that is out of range
std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings);

/// The same for a part of the box. It knows its own nodes only: shape(), node indices, states and arrays are
/// those of the part, with node 0 at `part.begin`. Populations that cross its cuts go by `exchange`; the
/// results are those of the whole box, to the last bit. Rows that do not touch a cut are advanced while
/// messages travel; where the box is cut along x all rows do.
///
/// Velocity, moments, states and the power of walls are known without waiting. free_velocity(),
/// dissipation(), restore() and step() wait for the neighbours' last step.
/// @param settings of the whole box
/// @param exchange not null, but if the part is the whole box
/// @throws std::invalid_argument as above, or if the part does not lie in the box or is too small
std::unique_ptr<Fluid> make_lattice_boltzmann(const LatticeBoltzmannSettings& settings, const GridPart& part,
                                              std::unique_ptr<HaloExchange> exchange);

/// Kinematic viscosity nu = (tau+ - 1/2)/3 of the nodes that have none of their own.
double viscosity_of(const LatticeBoltzmannSettings& settings);

/// Bytes of a number of the lattice.
inline constexpr int bytes_of_number(Storage storage) {
  return storage == Storage::single_precision ? 4 : 8;
}

/// Bytes of memory a node takes: its 19 populations. Left out: padding; force and velocity on nodes around
/// which forces have acted (below); 8 a node whose viscosity is not that of the settings, and two numbers of
/// the lattice where it differs within a pack of nodes (eight doubles or sixteen floats, with AVX-512).
inline constexpr int lattice_boltzmann_memory_per_node(Storage storage) {
  return 19 * bytes_of_number(storage);
}

/// Bytes of the force on a node, taken where one has acted; three numbers of the lattice are kept beside it.
inline constexpr int lattice_boltzmann_force_memory_per_node = 3 * 8;

/// Bytes that a step must move to and from memory for each node without a force: each population once in and
/// once out.
inline constexpr int lattice_boltzmann_bytes_per_node(Storage storage) {
  return 2 * lattice_boltzmann_memory_per_node(storage);
}

/// Bytes of a node in the largest array of a state, its populations as doubles.
inline constexpr int lattice_boltzmann_populations_per_node = 19 * 8;

/// Bytes of a node in a state: populations and force, as doubles (8 more where each node has its viscosity).
inline constexpr int lattice_boltzmann_state_per_node = lattice_boltzmann_populations_per_node + 3 * 8;

}  // namespace tanktread::fluid
