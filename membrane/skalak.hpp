#pragma once

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane {

/// Skalak et al. 1973 (doi 10.1016/S0006-3495(73)85983-1) in the thesis's form, Eq. 2.4:
/// W = E_s/8 (I1^2 + 2 I1 - 2 I2) + E_a/8 I2^2, E_a = C E_s; G_s = E_s/2, K_s = G_s (1 + 2 C).
std::unique_ptr<ElasticLaw> make_skalak(const ElasticParameters& parameters);

}  // namespace tanktread::membrane
