#pragma once

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane {

/// No elastic law, W = 0: a membrane without shear elasticity and without a tension of its own, as that of a
/// vesicle. What it has are energies of the whole membrane (membrane/energy_terms.hpp). It has no parameters.
std::unique_ptr<ElasticLaw> make_no_law(const ElasticParameters& parameters);

}  // namespace tanktread::membrane
