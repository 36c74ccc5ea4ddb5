#include "driver/plan/echo_capsule.hpp"

#include <fmt/format.h>

#include <cmath>

#include "driver/case/case_programs.hpp"
#include "driver/plan/echo_energies.hpp"
#include "driver/plan/echo_shape.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/stability.hpp"

namespace tanktread::driver {
namespace {

void put_moduli(EchoTable& table, const Subject& subject, const CapsuleParameters& capsule) {
  const auto modulus = [&](const std::string& name, double value, const std::string& note) {
    table.row(name, number(value), in_si(subject, value, newton_per_metre, "N/m"), note, value > 0);
  };
  const auto capillary = [&](const std::string& name, double value, const std::string& note) {
    table.row(name, number(value), "", note, value > 0);
  };
  capillary("Ca by E_s", capsule.capillary_by_E_s, "mu_o g a/E_s; W = E_s/8 (...)");
  capillary("Ca by G_s", capsule.capillary_by_G_s, "mu_o g a/G_s");
  capillary("Ca by gamma", capsule.capillary_by_gamma, "mu_o g a/gamma");
  capillary("Ca by kappa_b", capsule.capillary_by_kappa_b, "mu_o g a^3/kappa_b");
  modulus("E_s", capsule.skalak_modulus, "2 G_s");
  modulus("G_s", capsule.shear_modulus, "shear modulus at rest");
  modulus("K_s", capsule.area_modulus, "area modulus at rest, by the law");
  modulus("gamma", capsule.interfacial_tension, "mu_o g a/Ca");
}

/// How stiff the spring of an explicit scheme may be.
void put_limits(EchoTable& table, const Subject& subject, const std::string& part, double viscosity,
                double spring, int interval) {
  const auto& coupler = subject.the_case.coupler;
  const double in_viscosities = stable_interval_times_spring(coupler.kernel, coupler.tangential_correction);
  const double limit = in_viscosities * subject.parameters.kinematic_viscosity;
  table.row(fmt::format("N k_{}'", part), number(interval * spring), "",
            fmt::format("stable up to {:.3g} = {} mu_o", limit, in_viscosities));
  table.row(fmt::format("largest kappa_{}", part),
            fmt::format("{:.4g}", 2 * limit / (interval * viscosity * subject.parameters.shear_rate)), "",
            fmt::format("that is stable at N = {}", interval));
  table.row("largest N", fmt::format("{:.0f}", std::floor(limit / spring)), "",
            fmt::format("that is stable with this k_{}'{}", part, spring > limit ? ": none" : ""));
}

/// A part of the viscosity: its Boussinesq number, viscosity, and spring in all three forms.
void put_viscous_part(EchoTable& table, const Subject& subject, const std::string& part, double boussinesq,
                      double viscosity, double spring, int interval, bool is_explicit) {
  if (viscosity == 0) {
    table.row("Bq_" + part, "0");
    return;
  }
  table.row("Bq_" + part, number(boussinesq), "", fmt::format("mu_{}/(mu_o a)", part));
  table.row("mu_" + part, number(viscosity), in_si(subject, viscosity, newton_second_per_metre, "N s/m"),
            fmt::format("Bq_{} mu_o a", part));
  if (spring == 0) {
    table.row(fmt::format("k_{}'", part), "none", "", "a dashpot without a spring");
    return;
  }
  const double g = subject.parameters.shear_rate, tau = viscosity / spring;
  table.row(fmt::format("kappa_{}", part), number(2 / (tau * g)), "",
            subject.the_case.flow.kind == "periodic" ? fmt::format("2 k_{0}'/(g mu_{0})", part)
                                                     : fmt::format("L k_{0}'/(U0 mu_{0})", part));
  table.row(fmt::format("k_{}'", part), number(spring), in_si(subject, spring, newton_per_metre, "N/m"),
            fmt::format("kappa_{0} g mu_{0}/2", part));
  if (is_explicit) put_limits(table, subject, part, viscosity, spring, interval);
  table.row(fmt::format("tau_{}", part), number(tau), in_si(subject, tau, second, "s"),
            fmt::format("mu_{0}/k_{0}'; the element relaxes in twice that", part));
  table.row(fmt::format("tau_{} g", part), number(tau * g), "", fmt::format("g mu_{0}/k_{0}'", part));
}

void put_viscosity(EchoTable& table, const Subject& subject, const CapsuleParameters& capsule,
                   const ViscousCase& viscous) {
  if (!capsule.viscous) {
    table.row("Bq_s, Bq_d", "0, 0", "", "no membrane viscosity");
    return;
  }
  const auto& law = *capsule.viscous;
  const bool is_explicit = !is_implicit(law);
  table.row("viscous scheme", viscous.scheme, "",
            is_explicit ? viscous.stress_measure
                        : fmt::format("strain rates by {}, to {:g} in at most {} iterations",
                                      viscous.strain_rates, subject.the_case.coupler.implicit_tolerance,
                                      subject.the_case.coupler.implicit_iterations));
  table.row("interval N", fmt::format("{}", viscous.interval), "",
            viscous.strain_sampling == "latest" ? "steps; latest strain" : "steps; mean of the N strains",
            is_explicit);
  put_viscous_part(table, subject, "s", viscous.boussinesq_shear, law.shear_viscosity, law.shear_spring,
                   law.interval, is_explicit);
  put_viscous_part(table, subject, "d", viscous.boussinesq_dilatational, law.dilatational_viscosity,
                   law.dilatational_spring, law.interval, is_explicit);
}

}  // namespace

void put_capsule(EchoTable& table, const Subject& subject, std::size_t number_of_it,
                 const ShapeNumbers& shape) {
  const auto& the_capsule = subject.the_case.capsules[number_of_it];
  const auto& capsule = subject.parameters.capsules[number_of_it];
  const auto& at = the_capsule.position;
  table.section(fmt::format("capsule {}", number_of_it));
  table.row("radius a", number(capsule.radius), in_si(subject, capsule.radius, metre, "m"), "grid steps");
  table.row("position", fmt::format("{:.6g}, {:.6g}, {:.6g}", at[0], at[1], at[2]), "", "grid steps");
  put_shape(table, subject, number_of_it, shape);
  const bool has_program = !the_capsule.membrane.command.empty();
  table.row("membrane program", short_text(the_capsule.membrane.command), "", "", has_program);
  table.row(has_program ? "moduli by elastic law" : "elastic law", the_capsule.membrane.elastic_law, "",
            the_capsule.membrane.elastic_law == "skalak"
                ? fmt::format("C = {:.6g}", the_capsule.membrane.area_ratio)
                : "");
  put_moduli(table, subject, capsule);
  put_energies(table, subject, number_of_it, shape.mean_edge);
  if (!has_program) put_viscosity(table, subject, capsule, the_capsule.membrane.viscous);
  const double ratio = capsule.viscosity_ratio, inner = ratio * subject.parameters.kinematic_viscosity;
  table.row("viscosity ratio lambda", number(ratio), "", "mu_i/mu_o");
  table.row("viscosity mu_i", number(inner), in_si(subject, inner, pascal_second, "Pa s"), "lambda mu_o",
            ratio != 1);
  table.row("tau+ inside", number(inner_relaxation_time(subject.parameters, ratio)), "", "1/2 + 3 lambda nu",
            ratio != 1);
}

}  // namespace tanktread::driver
