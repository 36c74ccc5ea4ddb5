#include "driver/plan/warnings_si.hpp"

#include <fmt/format.h>

#include "driver/case/schema.hpp"
#include "driver/units/si.hpp"

namespace tanktread::driver {
namespace {

/// From the thinnest to the thickest that is met, generously: vesicles to balls of millimetres, gases to
/// syrups, red cells to shells of polymer.
struct Usual {
  const char* key;
  double least, greatest;
};

constexpr Usual usual[] = {
    {"si.radius_m", 1e-8, 1e-2},
    {"si.shear_rate_per_s", 1e-4, 1e7},
    {"si.viscosity_Pa_s", 1e-6, 1e3},
    {"si.inner_viscosity_Pa_s", 1e-6, 1e3},
    {"si.density_kg_per_m3", 0.1, 3e4},
    {"si.shear_modulus_N_per_m", 1e-9, 1e2},
    {"si.interfacial_tension_N_per_m", 1e-9, 1e1},
    {"si.membrane_shear_viscosity_N_s_per_m", 1e-13, 1e0},
    {"si.membrane_dilatational_viscosity_N_s_per_m", 1e-13, 1e0},
    {"si.bending_modulus_J", 1e-21, 1e-12},
    {"si.global_area_modulus_N_per_m", 1e-9, 1e2},
    {"si.local_area_modulus_N_per_m", 1e-9, 1e2},
    {"si.volume_modulus_N_per_m2", 1e-3, 1e9},
};

void warn_of_values(std::vector<std::string>& lines, const Case& the_case) {
  for (const auto& [path, least, greatest] : usual) {
    const Key& key = *find_key(path);
    const auto held = key.get(the_case, 0);
    const auto* value = std::get_if<double>(&held);
    if (value == nullptr || *value == 0 || (*value >= least && *value <= greatest)) continue;
    lines.push_back(fmt::format("{} = {:.4g} {} is outside {:g} to {:g}, which is unusual; check its unit",
                                path, *value, key.unit, least, greatest));
  }
}

void warn_of_density(std::vector<std::string>& lines, const Case& the_case, const Parameters& parameters,
                     const SiScales& scales) {
  constexpr double far = 100;
  const double run = si_of(the_case, parameters, scales).density_kg_per_m3;
  const double ratio = run / the_case.si->density_kg_per_m3;
  if (ratio <= far && ratio >= 1 / far) return;
  lines.push_back(
      fmt::format("the run has a density of {:.4g} kg/m^3, {:.4g} times si.density_kg_per_m3, for its "
                  "Reynolds number {:.4g} is as "
                  "many times the physical one; change flow.reynolds_number (or flow.wall_speed), or check "
                  "the values of [si]",
                  run, ratio, parameters.reynolds_number));
}

}  // namespace

std::vector<std::string> si_warnings(const Case& the_case, const Parameters& parameters) {
  std::vector<std::string> lines;
  const auto scales = si_scales(the_case, parameters);
  if (!scales) return lines;
  warn_of_values(lines, the_case);
  warn_of_density(lines, the_case, parameters, *scales);
  return lines;
}

}  // namespace tanktread::driver
