// The interface of an energy of a whole membrane: of its areas, its volume and its curvature.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "membrane/surface_measures.hpp"

namespace tanktread::membrane {

/// What a term answers: its energy and the derivatives by the measures of the surface. The nodal forces
/// -dE/dx follow from these in one place for every term alike (MeasuredSurface). A term is const, keeps
/// nothing between calls and knows no triangles. Its functions do not throw: parameters are checked where it
/// is made.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  /// Force times length.
  virtual double energy(const SurfaceMeasures& measures) const = 0;
  /// Adds the derivatives of the energy. `derivatives` has an entry a triangle and a node.
  virtual void add_derivatives(const SurfaceMeasures& measures, MeasureDerivatives& derivatives) const = 0;
  /// Whether it depends on node_area and node_curvature, which cost more than the rest.
  virtual bool depends_on_curvature() const { return false; }
};

/// Parameters by their names, in the unit of the points and of force.
using EnergyParameters = std::map<std::string, double>;

/// What a parameter may be.
enum class EnergyRange { not_negative, positive, finite };

/// A parameter of a term.
struct EnergyParameter {
  std::string name;
  std::string meaning;  ///< symbol, unit, and what it is if it is left out
  EnergyRange range;
  /// Its value if it is left out; empty: it must be given. @param reference measures of the reference surface
  std::function<double(const SurfaceMeasures& reference)> otherwise;
};

/// One row of the table of terms (membrane/energy_table.cpp).
struct EnergyTermEntry {
  std::string name;         ///< "bending", "global-area", "local-area", "volume"
  std::string description;  ///< one line with the formula of E
  std::vector<EnergyParameter> parameters;
  /// @param reference measures of the reference surface, for the areas and the volume at rest
  /// @param parameters all of them, within their ranges
  std::unique_ptr<EnergyTerm> (*make)(const SurfaceMeasures& reference, const EnergyParameters& parameters);
};
const std::vector<EnergyTermEntry>& energy_term_table();

/// Makes a term by its name. @param parameters those without a value of their own at least
/// @throws std::invalid_argument that lists the known names of terms or parameters, or names the term, the
/// parameter, its value and what is allowed
std::unique_ptr<EnergyTerm> make_energy_term(const std::string& name, const SurfaceMeasures& reference,
                                             const EnergyParameters& parameters);

}  // namespace tanktread::membrane
