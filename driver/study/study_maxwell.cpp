#include "driver/study/study_maxwell.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "driver/study/study_check.hpp"
#include "membrane/viscous_law.hpp"

namespace tanktread::driver {
namespace {

double frequency(const MaxwellStudy& study) {
  return 2.0 * std::numbers::pi / study.period;
}

double strain(const MaxwellStudy& study, double time) {
  return study.strain_amplitude * (1.0 - std::cos(frequency(study) * time));
}

membrane::ViscousLaw law_of(const MaxwellStudy& study) {
  membrane::ViscousParameters parameters;
  parameters.scheme = study.scheme;
  parameters.shear_viscosity = 0.5 * study.viscosity / study.time_step;
  parameters.shear_spring = study.stiffness;
  parameters.measure = membrane::StressMeasure::rate_of_strain;
  return membrane::ViscousLaw(parameters);
}

void require_valid(const MaxwellStudy& study) {
  require_positive("viscosity", study.viscosity);
  require_positive("stiffness", study.stiffness);
  require_positive("strain amplitude", study.strain_amplitude);
  require_positive("period", study.period);
  require_positive("time step", study.time_step);
  require(study.time_step <= 0.5 * study.period,
          fmt::format("time step {} is more than half of the period {}; make it smaller", study.time_step,
                      study.period));
  require(study.period / study.time_step <= MaxwellStudy::most_steps,
          fmt::format("time step {} is less than a part in {:g} of the period {}; make it longer",
                      study.time_step, MaxwellStudy::most_steps, study.period));
}

/// Steps that end within the first period; a rounding above counts as within.
int n_steps(const MaxwellStudy& study) {
  return static_cast<int>(std::floor(study.period / study.time_step * (1.0 + 1e-12)));
}

}  // namespace

double exact_stress(const MaxwellStudy& study, double time) {
  const double omega = frequency(study), tau = study.relaxation_time(), product = omega * tau;
  const double transient = product * std::exp(-time / tau);
  return study.viscosity * omega * study.strain_amplitude *
         (std::sin(omega * time) - product * std::cos(omega * time) + transient) / (product * product + 1.0);
}

double dashpot_stress(const MaxwellStudy& study, double time) {
  const double omega = frequency(study);
  return study.viscosity * omega * study.strain_amplitude * std::sin(omega * time);
}

std::vector<double> computed_stress(const MaxwellStudy& study) {
  require_valid(study);
  const membrane::ViscousLaw law = law_of(study);
  membrane::ViscousState state{};
  membrane::SymmetricTensor last, next;
  std::vector<double> stress;
  for (int step = 1; step <= n_steps(study); ++step) {
    next.xy = strain(study, step * study.time_step);
    law.advance(last, next, state);
    stress.push_back(membrane::ViscousLaw::stress(state).xy);
    last = next;
  }
  return stress;
}

MaxwellErrors maxwell_errors(const MaxwellStudy& study) {
  const std::vector<double> computed = computed_stress(study);
  MaxwellErrors sums;
  double exact_norm = 0, dashpot_norm = 0;
  for (std::size_t k = 0; k < computed.size(); ++k) {
    const double time = (k + 1) * study.time_step;
    const double exact = exact_stress(study, time), dashpot = dashpot_stress(study, time);
    sums.artificial += std::pow(exact - dashpot, 2);
    sums.scheme += std::pow(computed[k] - exact, 2);
    sums.overall += std::pow(computed[k] - dashpot, 2);
    exact_norm += exact * exact;
    dashpot_norm += dashpot * dashpot;
  }
  return {std::sqrt(sums.artificial / dashpot_norm), std::sqrt(sums.scheme / exact_norm),
          std::sqrt(sums.overall / dashpot_norm)};
}

std::string maxwell_table(const std::vector<MaxwellStudy>& studies) {
  std::string table =
      "scheme,viscosity,stiffness,period,time_step,dt_over_T0,tau_over_T0,artificial_error_L0,"
      "scheme_error_L1,overall_error_L2\n";
  for (const auto& study : studies) {
    const MaxwellErrors errors = maxwell_errors(study);
    table +=
        fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", study.scheme, study.viscosity,
                    study.stiffness, study.period, study.time_step, study.time_step / study.period,
                    study.relaxation_time() / study.period, errors.artificial, errors.scheme, errors.overall);
  }
  return table;
}

}  // namespace tanktread::driver
