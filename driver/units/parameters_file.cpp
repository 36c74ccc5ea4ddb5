#include "driver/units/parameters_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "driver/case/toml_line.hpp"
#include "driver/program/version.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

void put(std::string& toml, const std::string& name, const Value& value, const std::string& meaning) {
  toml += toml_line(name, value, meaning);
}

/// What a capsule may not have is 0 there.
void put_if_given(std::string& toml, const std::string& name, double value, const std::string& meaning) {
  if (value > 0) put(toml, name, value, meaning);
}

void put_flow(std::string& toml, const FlowParameters& flow) {
  toml += "\n[flow]\n";
  put(toml, "shear_rate", flow.shear_rate, "1/steps; g");
  put(toml, "steps_per_shear_time", flow.steps_per_shear_time, "steps; 1/g");
  put_if_given(toml, "wall_speed", flow.wall_speed, "grid steps/step; U0");
  put(toml, "body_force", flow.body_force, "force on each node, of the kind of flow and of the key together");
  put(toml, "kinematic_viscosity", flow.kinematic_viscosity, "nu = mu_o = (tau+ - 1/2)/3");
  put(toml, "relaxation_time", flow.relaxation_time, "steps; tau+");
  put(toml, "relaxation_time_odd", flow.relaxation_time_odd, "steps; tau-");
  put(toml, "reynolds_number", flow.reynolds_number, "g a^2/nu, a of capsule 0");
  put(toml, "speed_limit", flow.speed_limit, "grid steps/step; a fluid that is as fast stops the run");
  put(toml, "mach_number", flow.mach_number, "U0 sqrt(3), without walls g a sqrt(3)");
}

/// @param interval 0: none, of an implicit viscosity
/// A part of the membrane viscosity, "shear" or "dilatational", with its letter in the formulas.
void put_viscous_part(std::string& toml, const std::string& part, char letter, double viscosity,
                      double spring, int interval, double boussinesq_unit) {
  if (viscosity == 0) return;
  put(toml, fmt::format("viscous.{}_viscosity", part), viscosity, fmt::format("mu_{}", letter));
  put(toml, fmt::format("viscous.boussinesq_{}", part), viscosity / boussinesq_unit,
      fmt::format("Bq_{0} = mu_{0}/(mu_o a)", letter));
  if (spring == 0) return;  // of an implicit viscosity
  put(toml, fmt::format("viscous.{}_spring", part), spring, fmt::format("k_{}'", letter));
  if (interval == 0) return;
  put(toml, fmt::format("viscous.interval_times_{}_spring", part), interval * spring,
      fmt::format("N k_{}'", letter));
}

void put_energies(std::string& toml, const EnergyModuli& energy) {
  put_if_given(toml, "bending_modulus", energy.bending_modulus, "kappa_b");
  if (energy.bending_modulus > 0) put(toml, "spontaneous_curvature", energy.spontaneous_curvature, "c_0");
  put_if_given(toml, "global_area_modulus", energy.global_area_modulus, "k_A");
  put_if_given(toml, "local_area_modulus", energy.local_area_modulus, "k_d");
  put_if_given(toml, "volume_modulus", energy.volume_modulus, "k_V");
}

void put_capsule(std::string& toml, const CapsuleParameters& capsule, double outer_viscosity) {
  toml += "\n[[capsule]]\n";
  put(toml, "radius", capsule.radius, "grid steps; a");
  put(toml, "viscosity_ratio", capsule.viscosity_ratio, "lambda = mu_i/mu_o");
  put_if_given(toml, "shear_modulus", capsule.shear_modulus, "G_s at rest");
  put_if_given(toml, "skalak_modulus", capsule.skalak_modulus, "E_s = 2 G_s");
  put_if_given(toml, "area_modulus", capsule.area_modulus, "K_s at rest");
  put_if_given(toml, "interfacial_tension", capsule.interfacial_tension, "gamma");
  put_if_given(toml, "capillary_by_G_s", capsule.capillary_by_G_s, "mu_o g a/G_s");
  put_if_given(toml, "capillary_by_E_s", capsule.capillary_by_E_s, "mu_o g a/E_s");
  put_if_given(toml, "capillary_by_gamma", capsule.capillary_by_gamma, "mu_o g a/gamma");
  put_if_given(toml, "capillary_by_kappa_b", capsule.capillary_by_kappa_b, "mu_o g a^3/kappa_b");
  put_energies(toml, capsule.energy);
  if (!capsule.viscous) return;
  const auto& viscous = *capsule.viscous;
  const double unit = outer_viscosity * capsule.radius;
  const int interval = is_implicit(viscous) ? 0 : viscous.interval;
  if (interval > 0) put(toml, "viscous.interval", interval, "steps; N");
  put_viscous_part(toml, "shear", 's', viscous.shear_viscosity, viscous.shear_spring, interval, unit);
  put_viscous_part(toml, "dilatational", 'd', viscous.dilatational_viscosity, viscous.dilatational_spring,
                   interval, unit);
}

}  // namespace

std::string commits_with(const std::filesystem::path& file, const std::string& ours) {
  std::string before = "unknown";
  try {
    before = toml::parse_file(file.string())["commit"].value_or(before);
  } catch (const toml::parse_error&) {
    // A run of before there was such a file, or one that a user has changed: no reason not to go on with it.
  }
  const auto comma = before.rfind(", ");
  const auto last = comma == std::string::npos ? before : before.substr(comma + 2);
  return last == ours ? before : before + ", " + ours;
}

std::string parameters_toml(const Parameters& parameters, const std::string& commits) {
  std::string toml =
      "# Written by tanktread: what follows from echo.toml, in lattice units (grid step = time step = "
      "density = 1).\n";
  put(toml, "program", std::string("tanktread ") + version, "that made this run");
  put(toml, "commit", commits,
      "that the program was built from; several: of those that went on with the run");
  put_flow(toml, parameters);
  for (const auto& capsule : parameters.capsules) put_capsule(toml, capsule, parameters.kinematic_viscosity);
  return toml;
}

}  // namespace tanktread::driver
