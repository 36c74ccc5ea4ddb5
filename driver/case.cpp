#include "driver/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "coupler/coupler.hpp"
#include "driver/case_reader.hpp"

namespace tanktread::driver {
namespace {

int axis_number(const std::string& name) {
  return name == "x" ? 0 : (name == "y" ? 1 : 2);
}

/// Every key that must stand there. Their absence is a problem of its own.
template <typename Value>
Value need(CaseReader& reader, const std::string& path, const std::optional<Value>& value,
           const Value& stand_in) {
  if (!value && !reader.has(path)) reader.problem(path, "is missing; give " + allowed_text(*find_key(path)));
  return value.value_or(stand_in);
}

/// A key that has no meaning beside another is refused, not passed over.
void refuse(CaseReader& reader, const std::string& path, const std::string& why) {
  if (reader.has(path)) reader.problem(path, why);
}

FlowCase read_flow(CaseReader& reader) {
  FlowCase flow;
  flow.kind = reader.text("flow.kind").value_or(flow.kind);
  flow.box = need(reader, "flow.box", reader.integers3("flow.box"), flow.box);
  flow.wall_axis = axis_number(reader.text("flow.wall_axis").value_or("z"));
  flow.flow_axis = axis_number(reader.text("flow.flow_axis").value_or("x"));
  flow.reynolds_number = reader.real("flow.reynolds_number");
  flow.wall_speed = reader.real("flow.wall_speed");
  flow.shear_rate = reader.real("flow.shear_rate");
  flow.relaxation_time = reader.real("flow.relaxation_time").value_or(flow.relaxation_time);
  flow.collision = reader.text("flow.collision").value_or(flow.collision);
  flow.magic_parameter = reader.real("flow.magic_parameter").value_or(flow.magic_parameter);
  flow.viscosity_ratio = reader.real("flow.viscosity_ratio").value_or(flow.viscosity_ratio);
  flow.start = reader.text("flow.start").value_or(flow.start);
  flow.body_force = reader.reals3("flow.body_force").value_or(flow.body_force);
  flow.inertia = reader.boolean("flow.inertia").value_or(flow.inertia);
  flow.speed_limit = reader.real("flow.speed_limit").value_or(flow.speed_limit);
  return flow;
}

void check_flow(CaseReader& reader, const FlowCase& flow, bool has_si) {
  if (flow.wall_axis == flow.flow_axis) {
    reader.problem("flow.flow_axis",
                   "is the wall axis too; the flow runs along the walls, choose another axis");
  }
  if (flow.collision == "bgk") {
    refuse(reader, "flow.magic_parameter",
           "has no meaning for collision = \"bgk\" (one relaxation time); remove it or use \"trt\"");
  }
  if (flow.kind == "periodic") {
    refuse(reader, "flow.wall_speed", "a periodic box has no walls; give shear_rate instead");
    refuse(reader, "flow.reynolds_number",
           "a periodic box takes its unit of time from shear_rate; give that instead");
    if (flow.start == "developed")
      reader.problem("flow.start", "a periodic box has no developed profile; use \"rest\"");
    if (!flow.shear_rate)
      reader.problem("flow.shear_rate", "is missing; a periodic box needs it as its unit of time");
    return;
  }
  refuse(reader, "flow.shear_rate",
         "follows from reynolds_number or wall_speed; it is for kind = \"periodic\" only");
  if (flow.reynolds_number && flow.wall_speed) {
    reader.problem("flow.wall_speed",
                   "contradicts flow.reynolds_number (one follows from the other); remove one of them");
  }
  if (!flow.reynolds_number && !flow.wall_speed && !has_si) {
    reader.problem("flow.reynolds_number", "is missing; give reynolds_number or wall_speed");
  }
}

std::string preset_modulus(const std::string& elastic_law) {
  if (elastic_law == "skalak") return "E_s";
  return elastic_law == "interfacial-tension" ? "gamma" : "G_s";
}

/// [membrane] with the capsule's own table over it. A message names the place where the value came from.
class MembraneReader {
 public:
  MembraneReader(CaseReader& reader, int capsule)
      : reader_(reader), own_(fmt::format("capsule.{}.membrane.", capsule)) {}

  MembraneCase read(bool has_si) {
    MembraneCase membrane;
    membrane.elastic_law = reader_.text(path("elastic_law")).value_or(membrane.elastic_law);
    membrane.capillary_modulus =
        reader_.text(path("capillary_modulus")).value_or(preset_modulus(membrane.elastic_law));
    membrane.area_ratio = reader_.real(path("area_ratio")).value_or(membrane.area_ratio);
    membrane.poisson_ratio = reader_.real(path("poisson_ratio")).value_or(membrane.poisson_ratio);
    const auto ca = path("capillary_number");
    if (has_si) {
      refuse(reader_, ca, "contradicts [si], which gives the modulus itself; remove one of them");
      refuse(reader_, path("capillary_modulus"),
             "has no meaning beside [si], which gives the modulus itself; remove it");
    } else {
      membrane.capillary_number = need(reader_, ca, reader_.real(ca), membrane.capillary_number);
    }
    check(membrane);
    return membrane;
  }

 private:
  std::string path(const std::string& key) const {
    return reader_.has(own_ + key) ? own_ + key : "membrane." + key;
  }

  void check(const MembraneCase& membrane) {
    const auto& law = membrane.elastic_law;
    if (law != "skalak")
      refuse(reader_, path("area_ratio"), "is a parameter of skalak; elastic_law is " + law + "; remove it");
    if (law != "hookean")
      refuse(reader_, path("poisson_ratio"),
             "is a parameter of hookean; elastic_law is " + law + "; remove it");
    const auto& modulus = membrane.capillary_modulus;
    const bool is_tension = law == "interfacial-tension";
    if (is_tension != (modulus == "gamma") || (modulus == "E_s" && law != "skalak")) {
      reader_.problem(path("capillary_modulus"),
                      fmt::format("does not go with elastic_law {}; use \"{}\"", law, preset_modulus(law)));
    }
  }

  CaseReader& reader_;
  std::string own_;
};

CapsuleCase read_capsule(CaseReader& reader, int number, const Case& the_case) {
  const auto prefix = fmt::format("capsule.{}.", number);
  CapsuleCase capsule;
  capsule.radius = need(reader, prefix + "radius", reader.real(prefix + "radius"), 1.0);
  capsule.position = need(reader, prefix + "position", reader.reals3(prefix + "position"), {0, 0, 0});
  capsule.mesh.shape = reader.text(prefix + "mesh.shape").value_or(capsule.mesh.shape);
  capsule.mesh.level = reader.integer(prefix + "mesh.level").value_or(capsule.mesh.level);
  capsule.mesh.file = reader.text(prefix + "mesh.file").value_or("");
  if (!capsule.mesh.file.empty()) {
    refuse(reader, prefix + "mesh.shape", "contradicts mesh.file; remove one of them");
    refuse(reader, prefix + "mesh.level", "has no meaning beside mesh.file; remove it");
    auto file = std::filesystem::path(capsule.mesh.file);
    if (file.is_relative()) file = the_case.file.parent_path() / file;
    if (!std::filesystem::is_regular_file(file)) {
      reader.problem(prefix + "mesh.file",
                     "there is no file " + file.string() + " (paths are taken from the case file's folder)");
    }
    capsule.mesh.file = std::filesystem::absolute(file).lexically_normal().string();
  }
  capsule.membrane = MembraneReader(reader, number).read(the_case.si.has_value());
  capsule.viscosity_ratio = reader.real(prefix + "viscosity_ratio").value_or(the_case.flow.viscosity_ratio);
  if (capsule.viscosity_ratio != 1.0) {
    reader.problem(
        reader.has(prefix + "viscosity_ratio") ? prefix + "viscosity_ratio" : "flow.viscosity_ratio",
        "only 1 can be run so far: the inside of a capsule is not tracked yet");
  }
  return capsule;
}

/// The membrane and its stencils must lie within the walls; on a periodic axis the capsule must not meet
/// itself.
void check_place(CaseReader& reader, int number, const CapsuleCase& capsule, const Case& the_case) {
  const double reach = coupler::kernel(the_case.coupler.kernel).half_width;
  const auto path = fmt::format("capsule.{}.position", number);
  for (int axis = 0; axis < 3; ++axis) {
    const double n = the_case.flow.box[axis], at = capsule.position[axis];
    if (the_case.flow.kind != "periodic" && axis == the_case.flow.wall_axis) {
      const double gap = std::min(at, n - at) - capsule.radius;
      if (gap < reach + 0.5) {
        reader.problem(
            path,
            fmt::format("leaves {:.6g} grid steps between capsule and wall across {}; kernel {} needs {}; "
                        "move it, make it smaller or the box higher",
                        gap, "xyz"[axis], the_case.coupler.kernel, reach + 0.5));
      }
    } else if (!(at >= 0 && at <= n)) {
      reader.problem(path, fmt::format("lies outside the box, 0 to {} along {}", n, "xyz"[axis]));
    } else if (2 * (capsule.radius + reach) > n) {
      reader.problem(
          path, fmt::format(
                    "the capsule (radius {:.6g}) meets its own periodic image along {}, {} grid steps away; "
                    "make it smaller or the box longer",
                    capsule.radius, "xyz"[axis], n));
    }
  }
}

void check_overlaps(CaseReader& reader, const Case& the_case) {
  for (std::size_t i = 0; i < the_case.capsules.size(); ++i) {
    for (std::size_t k = i + 1; k < the_case.capsules.size(); ++k) {
      const auto &a = the_case.capsules[i], &b = the_case.capsules[k];
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        double distance = a.position[axis] - b.position[axis];
        const bool periodic = the_case.flow.kind == "periodic" || axis != the_case.flow.wall_axis;
        if (periodic) distance = std::remainder(distance, the_case.flow.box[axis]);
        squared += distance * distance;
      }
      if (std::sqrt(squared) < a.radius + b.radius) {
        reader.problem(
            fmt::format("capsule.{}.position", k),
            fmt::format("overlaps capsule {}: {:.6g} grid steps apart, the radii sum to {:.6g}; move it", i,
                        std::sqrt(squared), a.radius + b.radius));
      }
    }
  }
}

std::optional<SiCase> read_si(CaseReader& reader) {
  if (!reader.has("si")) return std::nullopt;
  SiCase si;
  const auto required = [&](const std::string& path) { return need(reader, path, reader.real(path), 1.0); };
  si.radius_m = required("si.radius_m");
  si.shear_rate_per_s = required("si.shear_rate_per_s");
  si.viscosity_Pa_s = required("si.viscosity_Pa_s");
  si.density_kg_per_m3 = reader.real("si.density_kg_per_m3").value_or(1000.0);
  si.shear_modulus_N_per_m = reader.real("si.shear_modulus_N_per_m");
  si.interfacial_tension_N_per_m = reader.real("si.interfacial_tension_N_per_m");
  if (si.shear_modulus_N_per_m.has_value() == si.interfacial_tension_N_per_m.has_value()) {
    reader.problem(
        "si.shear_modulus_N_per_m",
        "give exactly one of shear_modulus_N_per_m (a capsule) and interfacial_tension_N_per_m (a droplet)");
  }
  return si;
}

/// The capillary number that [si] amounts to: Ca = mu g a/modulus, a of each capsule in the scale of the
/// first.
void apply_si(CaseReader& reader, const SiCase& si, Case& the_case) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    auto& membrane = the_case.capsules[k].membrane;
    const bool is_tension = membrane.elastic_law == "interfacial-tension";
    if (is_tension != si.interfacial_tension_N_per_m.has_value()) {
      reader.problem("si",
                     fmt::format("capsule {} has elastic_law {}, which needs si.{}", k, membrane.elastic_law,
                                 is_tension ? "interfacial_tension_N_per_m" : "shear_modulus_N_per_m"));
      continue;
    }
    const double radius = si.radius_m * the_case.capsules[k].radius / the_case.capsules[0].radius;
    const double modulus = is_tension ? *si.interfacial_tension_N_per_m : *si.shear_modulus_N_per_m;
    membrane.capillary_modulus = is_tension ? "gamma" : "G_s";
    membrane.capillary_number = si.viscosity_Pa_s * si.shear_rate_per_s * radius / modulus;
  }
  auto& flow = the_case.flow;
  if (flow.kind != "periodic" && !flow.reynolds_number && !flow.wall_speed) {
    flow.reynolds_number =
        si.density_kg_per_m3 * si.shear_rate_per_s * si.radius_m * si.radius_m / si.viscosity_Pa_s;
  }
}

OutputCase read_output(CaseReader& reader, const FlowCase& flow) {
  OutputCase output;
  output.observables_every = reader.real("output.observables_every").value_or(output.observables_every);
  output.membrane_every = reader.real("output.membrane_every").value_or(output.membrane_every);
  output.fluid_every = reader.real("output.fluid_every").value_or(output.fluid_every);
  output.fluid_box = reader.ranges3("output.fluid_box");
  for (std::size_t axis = 0; output.fluid_box && axis < 3; ++axis) {
    const auto& range = (*output.fluid_box)[axis];
    if (range[0] > range[1] || range[1] >= flow.box[axis]) {
      reader.problem("output.fluid_box",
                     fmt::format("first <= last <= {} is needed along {}", flow.box[axis] - 1, "xyz"[axis]));
    }
  }
  return output;
}

}  // namespace

Case parse_case(const std::string& text, const std::string& name, const std::filesystem::path& directory,
                const std::vector<std::string>& assignments) {
  CaseReader reader(text, name, assignments);
  Case the_case;
  the_case.file = directory / std::filesystem::path(name).filename();
  the_case.title = reader.text("title").value_or("");
  the_case.si = read_si(reader);
  the_case.flow = read_flow(reader);
  check_flow(reader, the_case.flow, the_case.si.has_value());
  the_case.coupler.kernel = reader.text("coupler.kernel").value_or(the_case.coupler.kernel);
  the_case.run.shear_time = reader.real("run.shear_time").value_or(the_case.run.shear_time);
  the_case.run.threads = reader.integer("run.threads").value_or(the_case.run.threads);
  the_case.run.checkpoint_every = reader.real("run.checkpoint_every").value_or(the_case.run.checkpoint_every);
  the_case.output = read_output(reader, the_case.flow);
  if (reader.n_capsules() == 0 && !reader.has("capsule"))
    reader.problem("capsule", "is missing; at least one [[capsule]] is needed");
  for (int k = 0; k < reader.n_capsules(); ++k)
    the_case.capsules.push_back(read_capsule(reader, k, the_case));
  // What follows compares numbers, each of which must be right by itself first.
  if (!reader.has_problems()) {
    for (int k = 0; k < reader.n_capsules(); ++k) check_place(reader, k, the_case.capsules[k], the_case);
    check_overlaps(reader, the_case);
    if (the_case.si) apply_si(reader, *the_case.si, the_case);
  }
  reader.finish();
  return the_case;
}

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& assignments) {
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file) || !stream) {
    throw InputError(
        fmt::format("{}: there is no such case file; give a .toml (docs/case-file.md)", file.string()));
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_case(text.str(), file.string(), std::filesystem::absolute(file).parent_path(), assignments);
}

}  // namespace tanktread::driver
