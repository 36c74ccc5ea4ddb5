// Two liquids between walls on the grid of the lattice Boltzmann solver: what is studied, and its steady
// flow.
#pragma once

#include <string>
#include <vector>

#include "driver/study/two_layers.hpp"

namespace tanktread::driver {

/// What drives the flow along x.
enum class LayersFlow {
  couette,  ///< the upper wall moves
  channel,  ///< a uniform body force
};

/// The viscosity of a node, whose cell reaches half a grid step below and above it. s is the share of the
/// cell that lies below the sheet.
enum class NodeViscosity {
  sharp,       ///< that of the node's side: mu_below if s > 1/2, else mu_above; what a run does
  harmonic,    ///< 1/mu = s/mu_below + (1 - s)/mu_above
  arithmetic,  ///< mu = s mu_below + (1 - s) mu_above
};

/// Walls at z = 0 and z = height, nodes at 1/2, 3/2 ...; periodic along x and y. No inertia: the flow is
/// Stokes flow and its size makes no difference. Lengths in grid steps, viscosities in lattice units.
struct LayersStudy {
  LayersFlow flow = LayersFlow::couette;
  NodeViscosity form = NodeViscosity::sharp;
  /// lambda, of the liquid below, which is the inside for the coupler, over that above.
  double viscosity_ratio = 5;
  int height = 32;                  ///< H, grid nodes from wall to wall
  double sheet = 0.375;             ///< height of the sheet over H, the mean over its places
  int n_places = 8;                 ///< the sheet is put at sheet H + (k + 1/2)/n_places - 1/2, k = 0 ...
  std::string kernel = "stockie6";  ///< of coupler::kernels()
  double magic_parameter = 3.0 / 16.0;
  /// tau+ of the less viscous liquid. With a given magic parameter the steady flow does not depend on it; the
  /// larger it is, the fewer steps does the flow take.
  double relaxation_time = 5;
  /// The flow is steady when no velocity changes by more than this share of the largest one in the time in
  /// which what differs from the steady flow falls by 1/e or more.
  double steadiness = 1e-9;
  int most_spans = 100;  ///< of that time, for the flow to become steady

  static constexpr int most_height = 1024, most_places = 1024;
  static constexpr double most_steps = 1e7;  ///< in which what differs from the steady flow falls by 1/e
  static constexpr double least_steadiness = 1e-12;  ///< below it rounding may go on for ever
};

/// The heights at which the sheet is put: midpoints of one grid step.
/// @throws std::invalid_argument naming the parameter that is out of range
std::vector<double> sheet_heights(const LayersStudy& study);

/// The exact flow with the sheet at a height: U = 0.01, or the F that makes the largest speed 0.01 where the
/// sheet is at its mean height.
TwoLayers exact_layers(const LayersStudy& study, double sheet_height);

/// The kinematic viscosity of each node with the sheet at a height, `height` numbers from the low wall on.
std::vector<double> node_viscosities(const LayersStudy& study, double sheet_height);

/// The steady velocity along x of each node by the lattice Boltzmann solver, from rest, under the walls and
/// the force of exact_layers().
/// @throws std::invalid_argument as the solver
/// @throws RunError if the flow is not steady after most_spans
std::vector<double> steady_velocities(const LayersStudy& study, double sheet_height);

}  // namespace tanktread::driver
