#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/progress.hpp"
#include "driver/schedule.hpp"
#include "driver/units.hpp"

namespace tanktread::driver {
namespace {

void line(std::string& text, const std::string& name, const std::string& value,
          const std::string& note = "") {
  text += fmt::format("  {:<26} {:<28} {}", name, value, note);
  while (text.back() == ' ') text.pop_back();
  text += '\n';
}

std::string bytes_text(double bytes) {
  if (bytes >= 1e9) return fmt::format("{:.2f} GB", 1e-9 * bytes);
  return fmt::format("{:.1f} MB", 1e-6 * bytes);
}

std::string speed_note(const Case& the_case) {
  if (the_case.flow.kind == "poiseuille") return "undisturbed centre speed U0 = g L/2";
  return "U0 = g L/2; walls move with -+U0";
}

void put_flow(std::string& text, const Case& the_case, const Parameters& p,
              const std::optional<SiScales>& si) {
  const auto& box = the_case.flow.box;
  text += "flow\n";
  line(text, "lattice", fmt::format("{} x {} x {}", box[0], box[1], box[2]),
       fmt::format("{:.3g} million nodes", 1e-6 * box[0] * box[1] * box[2]));
  line(text, "kind", the_case.flow.kind, "start: " + the_case.flow.start);
  if (the_case.flow.kind != "periodic")
    line(text, "wall speed", fmt::format("{:.6g}", p.wall_speed), speed_note(the_case));
  line(text, "shear rate g", fmt::format("{:.6g}", p.shear_rate), "a step; shear time = g t");
  line(text, "steps a shear time", fmt::format("{:.1f}", p.steps_per_shear_time), "1/g");
  line(text, "relaxation times", fmt::format("{:.6g}, {:.6g}", p.relaxation_time, p.relaxation_time_odd),
       "tau+, tau-");
  line(text, "kinematic viscosity", fmt::format("{:.6g}", p.kinematic_viscosity), "(tau+ - 1/2)/3");
  line(text, "Reynolds number", fmt::format("{:.6g}", p.reynolds_number), "g a^2/nu, a of capsule 0");
  line(text, "Mach number", fmt::format("{:.4g}", p.mach_number));
  if (si) {
    line(text, "grid step", fmt::format("{:.6g} m", si->length_m), "radius_m / radius");
    line(text, "time step", fmt::format("{:.6g} s", si->time_s), "g / shear_rate_per_s");
    line(text, "force unit", fmt::format("{:.6g} N", si->force_N),
         "viscosity_Pa_s / nu, times step^2 / time");
    line(text, "physical Reynolds number", fmt::format("{:.6g}", si->reynolds_number_physical),
         fmt::format("the run has {:.4g} times that", p.reynolds_number / si->reynolds_number_physical));
  }
}

void put_capsule(std::string& text, std::size_t number, const Case& the_case, const Parameters& p,
                 const std::optional<SiScales>& si) {
  const auto& capsule = p.capsules[number];
  const auto in_si = [&](double modulus) {
    return si ? fmt::format("{:.6g} N/m", modulus * si->force_N / si->length_m) : std::string();
  };
  text += fmt::format("capsule {}\n", number);
  line(text, "radius a", fmt::format("{:.6g} grid steps", capsule.radius),
       si ? fmt::format("{:.6g} m", capsule.radius * si->length_m) : "");
  line(text, "elastic law", the_case.capsules[number].membrane.elastic_law);
  if (capsule.interfacial_tension > 0) {
    line(text, "Ca by gamma", fmt::format("{:.6g}", capsule.capillary_by_gamma), "mu_o g a/gamma");
    line(text, "gamma", fmt::format("{:.6g}", capsule.interfacial_tension),
         in_si(capsule.interfacial_tension));
  } else {
    if (capsule.skalak_modulus > 0) {
      line(text, "Ca by E_s", fmt::format("{:.6g}", capsule.capillary_by_E_s),
           "mu_o g a/E_s; W = E_s/8 (...), E_s = 2 G_s");
      line(text, "E_s", fmt::format("{:.6g}", capsule.skalak_modulus), in_si(capsule.skalak_modulus));
    }
    line(text, "Ca by G_s", fmt::format("{:.6g}", capsule.capillary_by_G_s), "mu_o g a/G_s");
    line(text, "G_s", fmt::format("{:.6g}", capsule.shear_modulus), in_si(capsule.shear_modulus));
    line(text, "K_s", fmt::format("{:.6g}", capsule.area_modulus), "area modulus at rest");
  }
  line(text, "Bq_s, Bq_d", "0, 0", "no membrane viscosity");
  line(text, "lambda", fmt::format("{:.6g}", capsule.viscosity_ratio), "mu_i/mu_o");
}

}  // namespace

std::vector<std::string> warnings(const Case& the_case, const Parameters& p,
                                  const std::vector<double>& mean_edges) {
  std::vector<std::string> found;
  if (p.mach_number > 0.1) {
    found.push_back(fmt::format(
        "Mach number {:.3g} is over 0.1: compressibility errors; lower flow.reynolds_number or wall_speed",
        p.mach_number));
  }
  if (p.relaxation_time < 0.55) {
    found.push_back(
        fmt::format("tau+ = {:.4g} is below 0.55: little margin of stability; raise flow.relaxation_time",
                    p.relaxation_time));
  }
  if (p.relaxation_time > 2.0) {
    found.push_back(fmt::format("tau+ = {:.4g} is over 2: errors grow with it; lower flow.relaxation_time",
                                p.relaxation_time));
  }
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& capsule = the_case.capsules[k];
    if (k < mean_edges.size() && (mean_edges[k] < 0.5 || mean_edges[k] > 2.0)) {
      found.push_back(
          fmt::format("capsule {}: mean mesh edge {:.3g} grid steps, outside 0.5 to 2; change its mesh.level",
                      k, mean_edges[k]));
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double n = the_case.flow.box[axis], at = capsule.position[axis];
      const bool wall = the_case.flow.kind != "periodic" && axis == the_case.flow.wall_axis;
      const double gap = wall ? std::min(at, n - at) - capsule.radius : n - 2 * capsule.radius;
      if (gap < capsule.radius) {
        found.push_back(fmt::format("capsule {}: {:.3g} radii to {} along {}, below 1; enlarge flow.box", k,
                                    gap / capsule.radius, wall ? "the wall" : "its periodic image",
                                    "xyz"[axis]));
      }
    }
  }
  if (steps_of(the_case.run.shear_time, p) == 0) {
    found.push_back("run.shear_time is less than half a time step: nothing will be run");
  }
  return found;
}

std::string echo(const Case& the_case, const Parameters& p, const Cost& cost,
                 const std::vector<std::string>& warning_lines) {
  const auto si = si_scales(the_case, p);
  std::string text = the_case.title.empty() ? "" : the_case.title + "\n";
  put_flow(text, the_case, p, si);
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) put_capsule(text, k, the_case, p, si);
  text += "run\n";
  line(text, "kernel", the_case.coupler.kernel);
  line(text, "steps", fmt::format("{}", steps_of(the_case.run.shear_time, p)),
       fmt::format("to shear time {:.6g}", the_case.run.shear_time));
  line(text, "memory", bytes_text(cost.memory_bytes), "about");
  line(text, "disk", bytes_text(cost.disk_bytes), "about, with two checkpoints");
  if (cost.mlups > 0) {
    line(text, "predicted time", duration_text(cost.run_seconds),
         fmt::format("{:.1f} MLUPS measured now", cost.mlups));
  }
  for (const auto& warning : warning_lines) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace tanktread::driver
