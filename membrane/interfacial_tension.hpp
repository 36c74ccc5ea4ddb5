#pragma once

#include "membrane/elastic_law.hpp"

namespace tanktread::membrane {

/// The interface of a droplet: W = gamma sqrt(I2 + 1), energy per present area gamma, so that the Cauchy
/// stress is gamma I whatever the strain. It has no shear modulus and pulls at rest too (a pressure inside
/// balances it).
std::unique_ptr<ElasticLaw> make_interfacial_tension(const ElasticParameters& parameters);

}  // namespace tanktread::membrane
