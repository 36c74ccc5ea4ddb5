// Checks of the settings and what follows from them, shared by the fast and the plain solver. Internal to
// fluid/.
#pragma once

#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// Throws std::invalid_argument naming the setting, its value, the allowed range.
void check(const LatticeBoltzmannSettings& settings);

/// tau- from tau+: Lambda/(tau+ - 1/2) + 1/2, or tau+ itself for the single-rate model.
double odd_relaxation_time(const LatticeBoltzmannSettings& settings, double relaxation_time);

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
