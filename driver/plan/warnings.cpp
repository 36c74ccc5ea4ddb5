#include "driver/plan/warnings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "coupler/coupler.hpp"
#include "driver/case/case_geometry.hpp"
#include "driver/plan/warnings_si.hpp"
#include "driver/units/energy_limits.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/schedule.hpp"
#include "driver/units/stability.hpp"

namespace tanktread::driver {
namespace {

using Lines = std::vector<std::string>;

/// @param where "" or " in capsule K"
void warn_of_relaxation_time(Lines& lines, double relaxation_time, const std::string& where) {
  if (relaxation_time < 0.55) {
    lines.push_back(
        fmt::format("tau+ = {:.4g}{} is below 0.55: little is left to the limit of stability at 0.5; "
                    "raise flow.relaxation_time",
                    relaxation_time, where));
  }
  if (relaxation_time > 2.0) {
    lines.push_back(fmt::format(
        "tau+ = {:.4g}{} is over 2: discretisation errors grow with it; lower flow.relaxation_time",
        relaxation_time, where));
  }
}

/// The fluid in a capsule has its own relaxation time.
void warn_of_contrast(Lines& lines, std::size_t number, const Parameters& p) {
  const double ratio = p.capsules[number].viscosity_ratio;
  if (ratio == 1) return;
  warn_of_relaxation_time(lines, inner_relaxation_time(p, ratio), fmt::format(" in capsule {}", number));
}

void warn_of_flow(Lines& lines, const Case& the_case, const Parameters& p) {
  const auto& flow = the_case.flow;
  const std::string speed_keys =
      flow.kind == "periodic" ? "flow.shear_rate" : "flow.reynolds_number or flow.wall_speed";
  if (p.mach_number > 0.1) {
    lines.push_back(
        fmt::format("Mach number {:.3g} is over 0.1: the fluid is compressed noticeably; lower {}",
                    p.mach_number, speed_keys));
  }
  if (p.wall_speed >= p.speed_limit) {
    lines.push_back(
        fmt::format("wall speed {:.3g} is not below the speed limit {:.3g} that stops the run; "
                    "lower {}, or raise flow.speed_limit",
                    p.wall_speed, p.speed_limit, speed_keys));
  }
  warn_of_relaxation_time(lines, p.relaxation_time, "");
  if (p.reynolds_number > 1.0 && flow.inertia) {
    lines.push_back(
        fmt::format("Reynolds number {:.3g} is over 1: inertia deforms a capsule too, results are "
                    "not those of Stokes flow; lower {}, or set flow.inertia = false",
                    p.reynolds_number, speed_keys));
  }
}

std::string too_near(std::size_t number, const Case& the_case, double gap, const std::string& what) {
  return fmt::format("capsule {} is {:.3g} radii from {}, less than 1: it will feel it; enlarge flow.box",
                     number, gap / the_case.capsules[number].radius, what);
}

void warn_of_walls(Lines& lines, std::size_t number, const Case& the_case, const Placement& placement) {
  const auto& capsule = the_case.capsules[number];
  for (int axis = 0; axis < 3; ++axis) {
    if (!has_walls(the_case, axis)) continue;
    const double gap = gap_to_walls(the_case, capsule, axis, placement.extent(number, axis));
    if (gap >= capsule.radius) continue;
    lines.push_back(too_near(number, the_case, gap, fmt::format("the wall along {}", "xyz"[axis])) +
                    fmt::format(" or move capsule.{}.position", number));
  }
}

void warn_of_images(Lines& lines, std::size_t number, const Case& the_case, const Placement& placement) {
  const double radius = the_case.capsules[number].radius;
  for (const auto& image : placement.images(number, radius)) {
    lines.push_back(too_near(number, the_case, image.distance, "its periodic image along " + image.axes));
  }
}

void warn_of_neighbours(Lines& lines, std::size_t number, const Case& the_case, const Placement& placement) {
  const auto& kernel = coupler::kernel(the_case.coupler.kernel);
  for (std::size_t other = 0; other < number; ++other) {
    const auto nearest = placement.nearest(other, number, 2 * kernel.half_width);
    if (!nearest || nearest->distance >= 2 * kernel.half_width) continue;
    lines.push_back(
        fmt::format("capsules {} and {} are {:.3g} grid steps apart, less than the width {:g} of "
                    "kernel {}: the fluid between them is not resolved; change capsule.{}.position",
                    other, number, nearest->distance, 2 * kernel.half_width, kernel.name, number));
  }
}

void warn_of_membrane(Lines& lines, std::size_t number, const Case& the_case,
                      const std::vector<double>& mean_edges) {
  const auto& capsule = the_case.capsules[number];
  if (number < mean_edges.size() && (mean_edges[number] < 0.5 || mean_edges[number] > 2.0)) {
    const bool is_fine = mean_edges[number] < 0.5;
    const auto fix = !capsule.mesh.file.empty()
                         ? fmt::format("use a {} capsule.{}.mesh.file", is_fine ? "coarser" : "finer", number)
                         : fmt::format("{} capsule.{}.mesh.level", is_fine ? "lower" : "raise", number);
    lines.push_back(fmt::format(
        "capsule {}: the mean mesh edge is {:.3g} grid steps, outside 0.5 to 2: {}; {}", number,
        mean_edges[number], is_fine ? "work for no gain" : "the fluid leaks between the nodes", fix));
  }
}

/// A tension holds no triangle: the flow shears the mesh for ever, and long triangles pull less along than
/// across. D is off by at most some 6.4 strain/(Ca triangles) (cases/drop-contrast: 2 to 15 %).
void warn_of_a_sheared_mesh(Lines& lines, std::size_t number, const Case& the_case, double mean_edge) {
  constexpr double error_a_strain = 6.4, noticeable = 0.02;
  const auto& capsule = the_case.capsules[number];
  if (capsule.membrane.elastic_law != "interfacial-tension" || !(mean_edge > 0)) return;
  if (the_case.flow.kind == "periodic") return;  // where a shear rate is a unit alone
  const double radii_an_edge = capsule.radius / mean_edge;
  const double triangles = 16 * std::numbers::pi / std::numbers::sqrt3 * radii_an_edge * radii_an_edge;
  const double a_strain = error_a_strain / (capsule.membrane.capillary_number * triangles);
  if (a_strain * the_case.run.shear_time <= noticeable) return;
  lines.push_back(fmt::format(
      "capsule {}: a tension does not hold the triangles, which the flow shears for ever: D may be off by "
      "{:.2g} % of itself at run.shear_time = {:g}, and by {:.2g} % at {:.2g}; read it early, or use a finer "
      "mesh",
      number, 100 * a_strain * the_case.run.shear_time, the_case.run.shear_time, 100 * noticeable,
      noticeable / a_strain));
}

/// Beyond these a capsule either tears in nature, or keeps its shape and the flow has no part in it.
void warn_of_capillary_number(Lines& lines, std::size_t number, const Case& the_case) {
  const auto& membrane = the_case.capsules[number].membrane;
  // A membrane that is soft in bending keeps its area and so its shape.
  const double least = 1e-4, greatest = membrane.capillary_modulus == "kappa_b" ? 1e4 : 10;
  const double given = membrane.capillary_number;
  if (given >= least && given <= greatest) return;
  lines.push_back(fmt::format(
      "capsule {}: Ca = {:.4g} is outside {:g} to {:g}: {}; check {}", number, given, least, greatest,
      given > greatest ? "the membrane hardly resists the flow" : "the flow hardly deforms the membrane",
      the_case.si ? "the values of [si] and their units" : "membrane.capillary_number"));
}

/// A part of a membrane viscosity and its artificial spring.
struct ViscousPart {
  const char* letter;
  const char* suffix;  ///< of its keys
  double viscosity, spring;
};

std::array<ViscousPart, 2> parts_of(const membrane::ViscousParameters& viscous) {
  return {{{"s", "", viscous.shear_viscosity, viscous.shear_spring},
           {"d", "_dilatational", viscous.dilatational_viscosity, viscous.dilatational_spring}}};
}

/// An element relaxes within 2 tau, tau = mu/k'; an interval of half of that is the longest that a scheme
/// follows well.
void warn_of_interval(Lines& lines, std::size_t number, int interval, const ViscousPart& part) {
  if (interval * part.spring <= part.viscosity) return;
  lines.push_back(
      fmt::format("capsule {}: the interval of {} steps is longer than tau_{} = {:.3g} steps, half the "
                  "relaxation time of the element; lower membrane.viscous.interval or the spring's stiffness",
                  number, interval, part.letter, part.viscosity / part.spring));
}

void warn_of_stability(Lines& lines, std::size_t number, int interval, const ViscousPart& part,
                       double outer_viscosity, const CouplerCase& coupler) {
  const double in_viscosities = stable_interval_times_spring(coupler.kernel, coupler.tangential_correction);
  const double limit = in_viscosities * outer_viscosity;
  if (interval * part.spring <= limit) return;
  const double ratio = limit / (interval * part.spring);
  const double without_correction = stable_interval_times_spring(coupler.kernel, false);
  const bool is_enough = interval * part.spring <= without_correction * outer_viscosity;
  lines.push_back(fmt::format(
      "capsule {}: N k_{}' = {:.3g} is over {:.3g} = {} mu_o, beyond which runs break down or may: divide "
      "the stiffness of the spring (membrane.viscous.spring_...{}), the interval, or the speed of the flow "
      "by "
      "{:.3g}{}",
      number, part.letter, interval * part.spring, limit, in_viscosities, part.suffix, 1 / ratio,
      is_enough
          ? fmt::format(", or set coupler.tangential_correction = false (up to {} mu_o)", without_correction)
          : ""));
}

void warn_of_viscosity(Lines& lines, std::size_t number, const Case& the_case, const Parameters& p) {
  const auto& viscous = the_case.capsules[number].membrane.viscous;
  if (!the_case.capsules[number].membrane.command.empty()) {
    if (viscous == ViscousCase()) return;
    lines.push_back(
        fmt::format("capsule {}: membrane.command takes the place of the viscous law too, and "
                    "membrane.viscous has no effect; remove it",
                    number));
    return;
  }
  if (viscous.scheme == "none") {
    if (viscous == ViscousCase()) return;
    lines.push_back(
        fmt::format("capsule {}: a membrane viscosity is given, but viscous.scheme = \"none\" leaves "
                    "it out; set membrane.viscous.scheme",
                    number));
    return;
  }
  if (!p.capsules[number].viscous) {
    lines.push_back(
        fmt::format("capsule {}: viscous.scheme = \"{}\", but both Boussinesq numbers are 0; set "
                    "membrane.viscous.boussinesq_shear or boussinesq_dilatational",
                    number, viscous.scheme));
    return;
  }
  const auto& law = *p.capsules[number].viscous;
  for (const auto& part : parts_of(law)) {
    if (part.viscosity == 0 || is_implicit(law)) continue;
    warn_of_interval(lines, number, law.interval, part);
    warn_of_stability(lines, number, law.interval, part, p.kinematic_viscosity, the_case.coupler);
  }
}

/// The forces of the energies are explicit too; and what rests or curves nothing has no effect.
void warn_of_energies(Lines& lines, std::size_t number, const Case& the_case, const Parameters& p,
                      const std::vector<double>& mean_edges) {
  if (!the_case.capsules[number].membrane.command.empty()) return;
  const double mean_edge = number < mean_edges.size() ? mean_edges[number] : 0;
  for (const auto& limit : energy_limits(the_case, p, number, mean_edge)) {
    if (limit.value <= limit.most) continue;
    lines.push_back(
        fmt::format("capsule {}: {} = {:.3g} is over {:.3g}, beyond which runs break down or may: divide "
                    "{} or the speed of the flow by {:.3g}",
                    number, limit.name, limit.value, limit.most,
                    the_case.si ? "its modulus in [si]" : "membrane." + limit.key, limit.value / limit.most));
  }
  const auto& energy = p.capsules[number].energy;
  const auto& given = the_case.capsules[number].membrane.energy;
  const auto idle = [&](bool is_given, bool has_effect, const char* key, const char* of) {
    if (is_given && !has_effect)
      lines.push_back(fmt::format("capsule {}: {} has no effect without {}", number, key, of));
  };
  idle(given.spontaneous_curvature != 0, energy.bending_modulus > 0, "spontaneous_curvature",
       "a bending modulus");
  idle(given.reference_area != 1, energy.global_area_modulus > 0 || energy.local_area_modulus > 0,
       "membrane.reference_area", "a global or a local area modulus");
  idle(given.reference_volume != 1, energy.volume_modulus > 0, "membrane.reference_volume",
       "a volume modulus");
}

/// Intervals become whole steps; a change of over 1 % will be seen in a plot.
void warn_of_rounding(Lines& lines, const Case& the_case, const Parameters& p) {
  constexpr double noticeable = 0.01;
  const std::pair<const char*, double> intervals[] = {
      {"output.observables_every", the_case.output.observables_every},
      {"output.measures_every", the_case.output.measures_every},
      {"output.energy_every", the_case.output.energy_every},
      {"output.membrane_every", the_case.output.membrane_every},
      {"output.fluid_every", the_case.output.fluid_every},
      {"run.checkpoint_every", the_case.run.checkpoint_every}};
  for (const auto& [key, every] : intervals) {
    const double wanted = every * p.steps_per_shear_time;
    const auto interval = static_cast<double>(schedule_of(every, p).interval);
    if (every == 0 || std::abs(interval - wanted) <= noticeable * wanted) continue;
    lines.push_back(
        fmt::format("{} = {:.6g} shear times is {:.4g} steps, rounded to {:.0f}; set it to {:.6g}", key,
                    every, wanted, interval, interval / p.steps_per_shear_time));
  }
  if (last_step_of(the_case, p) == 0) {
    lines.push_back("run.shear_time is less than half a time step: nothing will be run; raise it");
  }
}

}  // namespace

std::vector<std::string> warnings(const Case& the_case, const Parameters& parameters,
                                  const std::vector<double>& mean_edges, const Placement& placement) {
  Lines lines;
  warn_of_flow(lines, the_case, parameters);
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    warn_of_membrane(lines, k, the_case, mean_edges);
    warn_of_a_sheared_mesh(lines, k, the_case, k < mean_edges.size() ? mean_edges[k] : 0);
    warn_of_capillary_number(lines, k, the_case);
    warn_of_viscosity(lines, k, the_case, parameters);
    warn_of_energies(lines, k, the_case, parameters, mean_edges);
    warn_of_contrast(lines, k, parameters);
    warn_of_walls(lines, k, the_case, placement);
    warn_of_images(lines, k, the_case, placement);
    warn_of_neighbours(lines, k, the_case, placement);
  }
  warn_of_rounding(lines, the_case, parameters);
  for (auto& line : si_warnings(the_case, parameters)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace tanktread::driver
