// From a capsule's case and its parameters to the laws of its membrane.
#pragma once

#include <memory>
#include <optional>

#include "driver/case/case.hpp"
#include "membrane/elastic_law.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::driver {

struct CapsuleParameters;

/// The elastic law of a capsule with its moduli in lattice units.
std::unique_ptr<membrane::ElasticLaw> elastic_law(const MembraneCase& membrane,
                                                  const CapsuleParameters& capsule);

/// What a viscous law is made from, lattice units; none: the case switches it off, or both viscosities are 0.
/// Formulas: docs/units.md. @param outer_viscosity mu_o
std::optional<membrane::ViscousParameters> viscous_parameters(const ViscousCase& viscous,
                                                              double outer_viscosity, double radius,
                                                              double shear_rate);

/// The viscous law of a capsule; null: none.
std::unique_ptr<membrane::ViscousLaw> viscous_law(const CapsuleParameters& capsule);

}  // namespace tanktread::driver
