#pragma once

#include "membrane/energy_term.hpp"

namespace tanktread::membrane {

/// The area of each triangle is held: E = sum over triangles of k_d/2 (A_t - A_t0)^2/A_t0 (as in Fedosov et
/// al. 2010, doi:10.1016/j.cma.2010.02.001). "local_area_modulus" is k_d (force per length); the area modulus
/// at small strain is k_d, added to that of the elastic law. A_t0 is that of the reference surface times one
/// factor, by which their sum is "reference_area".
std::unique_ptr<EnergyTerm> make_local_area(const SurfaceMeasures& reference,
                                            const EnergyParameters& parameters);

}  // namespace tanktread::membrane
