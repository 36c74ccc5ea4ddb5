// All energies of a whole membrane, by their names. A new one is one row here.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "membrane/bending.hpp"
#include "membrane/enclosed_volume.hpp"
#include "membrane/global_area.hpp"
#include "membrane/local_area.hpp"

namespace tanktread::membrane {

const std::vector<EnergyTermEntry>& energy_term_table() {
  const auto zero = [](const SurfaceMeasures&) { return 0.0; };
  const auto area = [](const SurfaceMeasures& reference) { return reference.area; };
  const auto volume = [](const SurfaceMeasures& reference) { return reference.volume; };
  using enum EnergyRange;
  static const std::vector<EnergyTermEntry> table = {
      {"bending",
       "E = sum over nodes of 2 kappa_b (M_i - c_0 A_i/2)^2/A_i",
       {{"bending_modulus", "kappa_b, force times length", not_negative, {}},
        {"spontaneous_curvature", "c_0, one over length, 2/R of a sphere; 0 by default", finite, zero}},
       make_bending},
      {"global-area",
       "E = k_A/2 (A - A_0)^2/A_0",
       {{"area_modulus", "k_A, force per length", not_negative, {}},
        {"reference_area", "A_0; that of the reference surface by default", positive, area}},
       make_global_area},
      {"local-area",
       "E = sum over triangles of k_d/2 (A_t - A_t0)^2/A_t0",
       {{"local_area_modulus", "k_d, force per length", not_negative, {}},
        {"reference_area", "sum of A_t0; that of the reference surface by default", positive, area}},
       make_local_area},
      {"volume",
       "E = k_V/2 (V - V_0)^2/V_0",
       {{"volume_modulus", "k_V, force per area", not_negative, {}},
        {"reference_volume", "V_0; that of the reference surface by default", positive, volume}},
       make_enclosed_volume},
  };
  return table;
}

namespace {

template <class Rows>
std::string names_of(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

const EnergyTermEntry& entry_of(const std::string& name) {
  const auto& table = energy_term_table();
  const auto entry = std::ranges::find(table, name, &EnergyTermEntry::name);
  if (entry == table.end())
    throw std::invalid_argument("unknown energy term '" + name + "'; known are " + names_of(table));
  return *entry;
}

std::string allowed(EnergyRange range) {
  if (range == EnergyRange::finite) return "finite";
  return range == EnergyRange::positive ? "positive" : "0 or positive";
}

bool is_within(EnergyRange range, double value) {
  if (!std::isfinite(value)) return false;
  if (range == EnergyRange::finite) return true;
  return range == EnergyRange::positive ? value > 0 : value >= 0;
}

double value_of(const EnergyTermEntry& entry, const EnergyParameter& parameter,
                const SurfaceMeasures& reference, const EnergyParameters& given) {
  const auto found = given.find(parameter.name);
  if (found == given.end() && parameter.otherwise) return parameter.otherwise(reference);
  std::ostringstream is;
  is << "energy term " << entry.name << ": " << parameter.name << " is ";
  if (found == given.end()) {
    throw std::invalid_argument(is.str() + "missing (" + parameter.meaning + "), must be " +
                                allowed(parameter.range));
  }
  if (!is_within(parameter.range, found->second)) {
    is << found->second << ", must be " << allowed(parameter.range);
    throw std::invalid_argument(is.str());
  }
  return found->second;
}

}  // namespace

std::unique_ptr<EnergyTerm> make_energy_term(const std::string& name, const SurfaceMeasures& reference,
                                             const EnergyParameters& parameters) {
  const auto& entry = entry_of(name);
  for (const auto& [given, value] : parameters) {
    if (std::ranges::find(entry.parameters, given, &EnergyParameter::name) == entry.parameters.end()) {
      throw std::invalid_argument("energy term " + name + ": it has no parameter '" + given + "'; it has " +
                                  names_of(entry.parameters));
    }
  }
  EnergyParameters complete;
  for (const auto& parameter : entry.parameters)
    complete[parameter.name] = value_of(entry, parameter, reference, parameters);
  return entry.make(reference, complete);
}

}  // namespace tanktread::membrane
