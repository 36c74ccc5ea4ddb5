// How stiff the energies of a membrane beside its law may be for the length of the time step.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "driver/units/units.hpp"

namespace tanktread::driver {

/// A modulus and the largest that is safely stable, lattice units.
struct EnergyLimit {
  std::string name;  ///< kappa_b, k_A, k_d, k_V
  std::string key;   ///< in [membrane]
  double value = 0, most = 0;
};

/// Of the energies that a capsule has. Their forces are explicit: of the positions at the beginning of a
/// step. The limits are half of the least onset seen (docs/energy-terms.md, "How stiff"), by kernel as
/// stable_interval_times_spring(). @param mean_edge h of the mesh, grid steps
std::vector<EnergyLimit> energy_limits(const Case& the_case, const Parameters& parameters,
                                       std::size_t capsule, double mean_edge);

}  // namespace tanktread::driver
