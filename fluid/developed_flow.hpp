// What a solver starts from: the developed flow between walls, and the populations of either start. Shared by
// the fast and the plain solver. Internal to fluid/.
#pragma once

#include <array>

#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// Velocity and its gradient along the wall axis of the steady laminar flow between the walls at node (x, y,
/// z): Couette, plus Poiseuille of a body force along the walls. Zero without walls.
struct DevelopedFlow {
  std::array<double, 3> velocity = {0, 0, 0};
  std::array<double, 3> gradient = {0, 0, 0};
};
DevelopedFlow developed_flow(const LatticeBoltzmannSettings& settings, int x, int y, int z);

/// Outgoing (post-collision) populations, less the weights, with which a node starts: equilibrium, half the
/// body force, and for the developed flow the departure from equilibrium that keeps it steady.
std::array<double, 19> start_populations(const LatticeBoltzmannSettings& settings, int x, int y, int z);

}  // namespace tanktread::fluid
