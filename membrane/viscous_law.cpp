#include "membrane/viscous_law.hpp"

#include <cmath>
#include <stdexcept>

#include "membrane/element.hpp"

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
    : interval_(parameters.interval), sampling_(parameters.sampling), measure_(parameters.measure) {
  require(parameters.interval >= 1, "interval", parameters.interval, "1 or more");
  shear_ = maxwell_step(parameters, "shear", parameters.shear_viscosity, parameters.shear_spring);
  dilatation_ = maxwell_step(parameters, "dilatational", parameters.dilatational_viscosity,
                             parameters.dilatational_spring);
}

void ViscousLaw::advance(const Eigen::Matrix2d& last_strain, const Eigen::Matrix2d& strain,
                         ViscousState& state) const {
  Eigen::Matrix2d increment = strain - last_strain;
  if (measure_ == StressMeasure::rate_of_deformation) {
    const Eigen::Matrix2d mean_cauchy_green = Eigen::Matrix2d::Identity() + last_strain + strain;
    const Eigen::Matrix2d inverse = right_stretch(mean_cauchy_green).inverse();
    increment = inverse * increment * inverse;
  }
  state[0] = shear_.advance(state[0], 0.5 * (increment(0, 0) - increment(1, 1)));
  state[1] = shear_.advance(state[1], 0.5 * (increment(0, 1) + increment(1, 0)));
  state[2] = dilatation_.advance(state[2], 0.5 * (increment(0, 0) + increment(1, 1)));
}

Eigen::Matrix2d ViscousLaw::stress(const ViscousState& state) {
  Eigen::Matrix2d stress;
  stress << state[2] + state[0], state[1], state[1], state[2] - state[0];
  return stress;
}

}  // namespace tanktread::membrane
