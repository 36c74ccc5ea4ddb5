// The same method written for the eye instead of the machine: the yardstick of the fast solver.
#pragma once

#include <memory>

#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// Two arrays, one node at a time, the formulas as they stand in the paper (see make_lattice_boltzmann). Ten
/// to twenty times slower; one thread; agrees with the fast solver to rounding.
/// @throws std::invalid_argument naming the setting that is out of range
std::unique_ptr<Fluid> make_plain_lattice_boltzmann(const LatticeBoltzmannSettings& settings);

}  // namespace tanktread::fluid
