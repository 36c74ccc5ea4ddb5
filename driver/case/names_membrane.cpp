#include <algorithm>

#include "driver/case/names.hpp"
#include "membrane/elastic_law.hpp"
#include "membrane/maxwell.hpp"

namespace tanktread::driver {

std::vector<std::string> elastic_law_names() {
  std::vector<std::string> names;
  for (const auto& entry : membrane::elastic_law_table()) names.push_back(entry.name);
  return names;
}

std::vector<std::string> elastic_laws_with(const std::string& parameter) {
  std::vector<std::string> names;
  for (const auto& entry : membrane::elastic_law_table()) {
    if (std::count(entry.parameters.begin(), entry.parameters.end(), parameter) > 0)
      names.push_back(entry.name);
  }
  return names;
}

std::vector<std::string> maxwell_scheme_names() {
  std::vector<std::string> names;
  for (const auto& scheme : membrane::maxwell_schemes()) names.push_back(scheme.name);
  return names;
}

}  // namespace tanktread::driver
