#pragma once

#include "membrane/energy_term.hpp"

namespace tanktread::membrane {

/// The area as a whole is held: E = k_A/2 (A - A_0)^2/A_0 (as in Fedosov et al. 2010,
/// doi:10.1016/j.cma.2010.02.001). The tension k_A (A - A_0)/A_0 is the same everywhere, as that of a fluid
/// bilayer. "area_modulus" is k_A (force per length), "reference_area" A_0.
std::unique_ptr<EnergyTerm> make_global_area(const SurfaceMeasures& reference,
                                             const EnergyParameters& parameters);

}  // namespace tanktread::membrane
