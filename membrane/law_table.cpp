// All elastic laws, by the name in the case file. A new law is one row here.
#include <stdexcept>

#include "membrane/hookean.hpp"
#include "membrane/interfacial_tension.hpp"
#include "membrane/neo_hookean.hpp"
#include "membrane/no_law.hpp"
#include "membrane/skalak.hpp"

namespace tanktread::membrane {

const std::vector<ElasticLawEntry>& elastic_law_table() {
  static const std::vector<ElasticLawEntry> table = {
      {"skalak",
       "W = E_s/8 (I1^2 + 2 I1 - 2 I2) + C E_s/8 I2^2, E_s = 2 G_s",
       {"shear_modulus", "area_ratio"},
       make_skalak},
      {"neo-hookean", "W = G_s/2 (I1 - 1 + 1/(I2 + 1))", {"shear_modulus"}, make_neo_hookean},
      {"hookean",
       "W = G_s (tr E^2 + nu_s/(1 - nu_s) (tr E)^2)",
       {"shear_modulus", "poisson_ratio"},
       make_hookean},
      {"interfacial-tension", "W = gamma sqrt(I2 + 1)", {"interfacial_tension"}, make_interfacial_tension},
      {"none", "W = 0: the membrane is of its energy terms alone", {}, make_no_law},
  };
  return table;
}

std::unique_ptr<ElasticLaw> make_elastic_law(const std::string& name, const ElasticParameters& parameters) {
  std::string known;
  for (const auto& entry : elastic_law_table()) {
    if (entry.name == name) return entry.make(parameters);
    known += (known.empty() ? "" : ", ") + entry.name;
  }
  throw std::invalid_argument("unknown elastic law '" + name + "'; known are " + known);
}

}  // namespace tanktread::membrane
