#include <fmt/format.h>

#include <toml++/toml.h>
#include <sstream>

#include "driver/case.hpp"

namespace tanktread::driver {
namespace {

/// A number as a TOML float, shortest that reads back to the same double.
std::string number(double value) {
  auto text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quoted(const std::string& text) {
  std::ostringstream stream;
  stream << toml::value<std::string>(text);
  return stream.str();
}

std::string axis_name(int axis) {
  return std::string(1, "xyz"[axis]);
}

void put(std::string& toml, const std::string& key, const std::string& value) {
  toml += fmt::format("{} = {}\n", key, value);
}

void put(std::string& toml, const std::string& key, const std::optional<double>& value) {
  if (value) put(toml, key, number(*value));
}

std::string numbers(const std::array<double, 3>& values) {
  return fmt::format("[{}, {}, {}]", number(values[0]), number(values[1]), number(values[2]));
}

void put_flow(std::string& toml, const FlowCase& flow) {
  toml += "\n[flow]\n";
  put(toml, "kind", quoted(flow.kind));
  put(toml, "box", fmt::format("[{}, {}, {}]", flow.box[0], flow.box[1], flow.box[2]));
  put(toml, "wall_axis", quoted(axis_name(flow.wall_axis)));
  put(toml, "flow_axis", quoted(axis_name(flow.flow_axis)));
  put(toml, "reynolds_number", flow.reynolds_number);
  put(toml, "wall_speed", flow.wall_speed);
  put(toml, "shear_rate", flow.shear_rate);
  put(toml, "relaxation_time", number(flow.relaxation_time));
  put(toml, "collision", quoted(flow.collision));
  if (flow.collision == "trt") put(toml, "magic_parameter", number(flow.magic_parameter));
  put(toml, "viscosity_ratio", number(flow.viscosity_ratio));
  put(toml, "start", quoted(flow.start));
  put(toml, "body_force", numbers(flow.body_force));
  put(toml, "inertia", flow.inertia ? "true" : "false");
  put(toml, "speed_limit", number(flow.speed_limit));
}

void put_capsule(std::string& toml, const CapsuleCase& capsule, bool has_si) {
  toml += "\n[[capsule]]\n";
  put(toml, "radius", number(capsule.radius));
  put(toml, "position", numbers(capsule.position));
  if (capsule.mesh.file.empty()) {
    put(toml, "mesh",
        fmt::format("{{ shape = {}, level = {} }}", quoted(capsule.mesh.shape), capsule.mesh.level));
  } else {
    put(toml, "mesh", fmt::format("{{ file = {} }}", quoted(capsule.mesh.file)));
  }
  put(toml, "viscosity_ratio", number(capsule.viscosity_ratio));
  toml += "[capsule.membrane]\n";
  const auto& membrane = capsule.membrane;
  put(toml, "elastic_law", quoted(membrane.elastic_law));
  if (!has_si) {
    put(toml, "capillary_number", number(membrane.capillary_number));
    put(toml, "capillary_modulus", quoted(membrane.capillary_modulus));
  }
  if (membrane.elastic_law == "skalak") put(toml, "area_ratio", number(membrane.area_ratio));
  if (membrane.elastic_law == "hookean") put(toml, "poisson_ratio", number(membrane.poisson_ratio));
}

void put_output(std::string& toml, const OutputCase& output) {
  toml += "\n[output]\n";
  put(toml, "observables_every", number(output.observables_every));
  put(toml, "membrane_every", number(output.membrane_every));
  put(toml, "fluid_every", number(output.fluid_every));
  if (output.fluid_box) {
    const auto& b = *output.fluid_box;
    put(toml, "fluid_box",
        fmt::format("[[{}, {}], [{}, {}], [{}, {}]]", b[0][0], b[0][1], b[1][0], b[1][1], b[2][0], b[2][1]));
  }
}

void put_si(std::string& toml, const SiCase& si) {
  toml += "\n[si]\n";
  put(toml, "radius_m", number(si.radius_m));
  put(toml, "shear_rate_per_s", number(si.shear_rate_per_s));
  put(toml, "viscosity_Pa_s", number(si.viscosity_Pa_s));
  put(toml, "density_kg_per_m3", number(si.density_kg_per_m3));
  put(toml, "shear_modulus_N_per_m", si.shear_modulus_N_per_m);
  put(toml, "interfacial_tension_N_per_m", si.interfacial_tension_N_per_m);
}

}  // namespace

std::string to_toml(const Case& the_case) {
  std::string toml = "# Written by tanktread: the case with every key resolved. It reproduces the run.\n";
  put(toml, "title", quoted(the_case.title));
  put_flow(toml, the_case.flow);
  for (const auto& capsule : the_case.capsules) put_capsule(toml, capsule, the_case.si.has_value());
  toml += "\n[coupler]\n";
  put(toml, "kernel", quoted(the_case.coupler.kernel));
  toml += "\n[run]\n";
  put(toml, "shear_time", number(the_case.run.shear_time));
  put(toml, "threads", fmt::format("{}", the_case.run.threads));
  put(toml, "checkpoint_every", number(the_case.run.checkpoint_every));
  put_output(toml, the_case.output);
  if (the_case.si) put_si(toml, *the_case.si);
  return toml;
}

}  // namespace tanktread::driver
