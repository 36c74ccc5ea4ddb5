#pragma once

#include "membrane/energy_term.hpp"

namespace tanktread::membrane {

/// Helfrich 1973 (doi:10.1515/znc-1973-11-1209): E = kappa_b/2 integral of (2 H - c_0)^2 dA, with the mean
/// curvature of Juelicher 1996 (doi:10.1051/jp2:1996178), H_i = M_i/A_i of a node:
/// E = sum over nodes of 2 kappa_b (M_i - c_0 A_i/2)^2/A_i. The integral of the Gaussian curvature is 4 pi
/// for any closed membrane, so it has no part in it. "bending_modulus" is kappa_b (force times length),
/// "spontaneous_curvature" c_0 (one over length; 2/R fits a sphere of radius R).
std::unique_ptr<EnergyTerm> make_bending(const SurfaceMeasures& reference,
                                         const EnergyParameters& parameters);

}  // namespace tanktread::membrane
