#include "membrane/viscous_law.hpp"

#include <cmath>
#include <stdexcept>

namespace tanktread::membrane {
namespace {

void require(bool fine, const std::string& name, double value, const std::string& allowed) {
  if (fine) return;
  throw std::invalid_argument("viscous law: " + name + " is " + std::to_string(value) + ", must be " +
                              allowed);
}

MaxwellStep maxwell_step(const ViscousParameters& parameters, const std::string& part, double viscosity,
                         double spring) {
  require(std::isfinite(viscosity) && viscosity >= 0, part + "_viscosity", viscosity, "0 or positive");
  if (viscosity == 0) return {};
  require(std::isfinite(spring) && spring > 0, part + "_spring", spring, "positive");
  return maxwell_scheme(parameters.scheme).step(2.0 * viscosity, spring, parameters.interval);
}

}  // namespace

ViscousLaw::ViscousLaw(const ViscousParameters& parameters)
    : interval_(parameters.interval),
      shear_viscosity_(parameters.shear_viscosity),
      dilatational_viscosity_(parameters.dilatational_viscosity),
      sampling_(parameters.sampling),
      measure_(parameters.measure) {
  require(parameters.interval >= 1, "interval", parameters.interval, "1 or more");
  shear_ = maxwell_step(parameters, "shear", parameters.shear_viscosity, parameters.shear_spring);
  dilatation_ = maxwell_step(parameters, "dilatational", parameters.dilatational_viscosity,
                             parameters.dilatational_spring);
}

}  // namespace tanktread::membrane
