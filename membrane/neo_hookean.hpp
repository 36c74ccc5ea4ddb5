#pragma once

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane {

/// Neo-Hookean membrane of an incompressible sheet: W = G_s/2 (I1 - 1 + 1/(I2 + 1)), K_s = 3 G_s
/// (Barthes-Biesel, Diaz & Dhenin 2002, doi 10.1017/S0022112002008352). W = 0 at rest.
std::unique_ptr<ElasticLaw> make_neo_hookean(const ElasticParameters& parameters);

}  // namespace tanktread::membrane
