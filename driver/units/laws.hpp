// From a capsule's case and its parameters to the laws of its membrane.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "membrane/elastic_law.hpp"
#include "membrane/energy_terms.hpp"
#include "membrane/mesh.hpp"
#include "membrane/viscous_parameters.hpp"

namespace tanktread::membrane {
class ImplicitViscosity;
class ViscousLaw;
}  // namespace tanktread::membrane

namespace tanktread::driver {

struct CapsuleParameters;
struct Parameters;

/// The elastic law of a capsule with its moduli in lattice units.
std::unique_ptr<membrane::ElasticLaw> elastic_law(const MembraneCase& membrane,
                                                  const CapsuleParameters& capsule);

/// The energies of a capsule's membrane beside its law, in the order of the table of terms; null: none.
/// @param start the mesh that the capsule starts as: its areas and its volume are those at rest, times the
/// ratios of the case
std::unique_ptr<membrane::EnergyTerms> energy_terms(const MembraneCase& membrane,
                                                    const CapsuleParameters& capsule,
                                                    const membrane::TriangleMesh& start, int threads);

/// The names of the energies that any capsule has beside its law, in the order of the table of terms.
std::vector<std::string> term_names(const Parameters& parameters);

/// A name of the table of terms as it is in files, "global_area" of "global-area".
std::string name_in_files(std::string term);

/// What a viscous law is made from, lattice units; none: the case switches it off, or both viscosities are 0.
/// Formulas: docs/units.md. @param outer_viscosity mu_o
std::optional<membrane::ViscousParameters> viscous_parameters(const ViscousCase& viscous,
                                                              double outer_viscosity, double radius,
                                                              double shear_rate);

/// Whether these are of an implicit viscosity; a spring of 0 is then none.
bool is_implicit(const membrane::ViscousParameters& viscous);

/// Whether any capsule has an implicit viscosity: not one with a program in the place of its laws.
bool any_implicit(const Case& the_case, const Parameters& parameters);

/// The viscous law of a capsule; null: none, or an implicit one.
std::unique_ptr<membrane::ViscousLaw> viscous_law(const CapsuleParameters& capsule);

/// The implicit viscosity of a capsule; null: none, or an explicit one.
std::unique_ptr<membrane::ImplicitViscosity> implicit_viscosity(const CapsuleParameters& capsule,
                                                                const membrane::TriangleMesh& mesh,
                                                                int threads);

}  // namespace tanktread::driver
