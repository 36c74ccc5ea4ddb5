// Checks of law parameters, with one wording for all laws.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace tanktread::membrane {

inline void require_law_parameter(bool fine, const std::string& law, const std::string& name, double value,
                                  const std::string& allowed) {
  if (!fine) {
    throw std::invalid_argument("elastic law " + law + ": " + name + " is " + std::to_string(value) +
                                ", must be " + allowed);
  }
}

inline void require_positive(const std::string& law, const std::string& name, double value) {
  require_law_parameter(std::isfinite(value) && value > 0, law, name, value, "positive");
}

inline void require_not_negative(const std::string& law, const std::string& name, double value) {
  require_law_parameter(std::isfinite(value) && value >= 0, law, name, value, "0 or positive");
}

}  // namespace tanktread::membrane
