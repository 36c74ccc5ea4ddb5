#pragma once

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane {

/// Generalised Hooke's law in the Green strain E: W = G_s [tr(E^2) + nu_s/(1 - nu_s) (tr E)^2],
/// K_s = G_s (1 + nu_s)/(1 - nu_s). For small strain: under compression it softens until it collapses.
/// In the invariants, tr E = I1/2 and tr(E^2) = (I1^2 + 2 I1 - 2 I2)/4.
std::unique_ptr<ElasticLaw> make_hookean(const ElasticParameters& parameters);

}  // namespace tanktread::membrane
