#pragma once

#include "membrane/energy_term.hpp"

namespace tanktread::membrane {

/// The volume is held: E = k_V/2 (V - V_0)^2/V_0 (as in Fedosov et al. 2010,
/// doi:10.1016/j.cma.2010.02.001). The pressure k_V (V - V_0)/V_0 is the same everywhere, inwards if the
/// volume is too large. "volume_modulus" is k_V (force per area), "reference_volume" V_0.
std::unique_ptr<EnergyTerm> make_enclosed_volume(const SurfaceMeasures& reference,
                                                 const EnergyParameters& parameters);

}  // namespace tanktread::membrane
