#include "membrane/maxwell.hpp"

#include <cmath>
#include <stdexcept>

namespace tanktread::membrane {
namespace {

MaxwellStep finite_difference(double viscosity, double stiffness, double time_step) {
  const double tau = viscosity / stiffness, sum = 2.0 * tau + time_step;
  return {(2.0 * tau - time_step) / sum, 2.0 * viscosity / sum};
}

MaxwellStep constant_rate(double viscosity, double stiffness, double time_step) {
  const double x = time_step * stiffness / viscosity;
  // 1 - exp(-x) without the loss of digits at small x.
  return {std::exp(-x), -std::expm1(-x) * viscosity / time_step};
}

MaxwellStep trapezoidal(double viscosity, double stiffness, double time_step) {
  const double decay = std::exp(-time_step * stiffness / viscosity);
  return {decay, 0.5 * (1.0 + decay) * stiffness};
}

}  // namespace

const std::vector<MaxwellScheme>& maxwell_schemes() {
  static const std::vector<MaxwellScheme> table = {
      {"fd", "central differences: A = (2 tau - dt)/(2 tau + dt), B = 2 dt/(2 tau + dt)", finite_difference},
      {"int1", "integral, constant strain rate: A = exp(-dt/tau), B = 1 - exp(-dt/tau)", constant_rate},
      {"int2", "integral, trapezoidal rule: A = exp(-dt/tau), B = (1 + exp(-dt/tau)) dt/(2 tau)",
       trapezoidal},
  };
  return table;
}

const MaxwellScheme& maxwell_scheme(const std::string& name) {
  std::string known;
  for (const auto& scheme : maxwell_schemes()) {
    if (scheme.name == name) return scheme;
    known += (known.empty() ? "" : ", ") + scheme.name;
  }
  throw std::invalid_argument("unknown Maxwell scheme '" + name + "'; known are " + known);
}

}  // namespace tanktread::membrane
