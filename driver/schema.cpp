#include "driver/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <regex>

namespace tanktread::driver {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Key boolean(std::string path, std::string preset, std::string meaning) {
  return {std::move(path),   Kind::boolean, std::move(preset), -infinity, infinity, true, {}, "",
          std::move(meaning)};
}
Key text(std::string path, std::string preset, std::vector<std::string> choices, std::string meaning) {
  return {std::move(path),    Kind::text, std::move(preset), -infinity, infinity, true,
          std::move(choices), "",         std::move(meaning)};
}
Key integer(std::string path, std::string preset, double least, double greatest, std::string unit,
            std::string meaning) {
  return {std::move(path), Kind::integer,     std::move(preset), least, greatest, true, {},
          std::move(unit), std::move(meaning)};
}
/// A real number from `least` on.
Key real_from(std::string path, std::string preset, double least, std::string unit, std::string meaning) {
  return {std::move(path), Kind::real,        std::move(preset), least, infinity, true, {},
          std::move(unit), std::move(meaning)};
}
/// A real number above `least`.
Key real_above(std::string path, std::string preset, double least, std::string unit, std::string meaning) {
  return {std::move(path), Kind::real,        std::move(preset), least, infinity, false, {},
          std::move(unit), std::move(meaning)};
}
Key list(std::string path, Kind kind, std::string preset, double least, std::string unit,
         std::string meaning) {
  return {std::move(path),   kind, std::move(preset), least, infinity, true, {}, std::move(unit),
          std::move(meaning)};
}

std::vector<Key> flow_keys() {
  return {
      text("flow.kind", "\"shear\"", {"shear", "poiseuille", "periodic"},
           "walls moving with -+U0; walls at rest and a body force; no walls"),
      list("flow.box", Kind::integers3, "required", 4, "grid steps", "fluid nodes along x, y, z"),
      text("flow.wall_axis", "\"z\"", {"x", "y", "z"},
           "normal of the walls; the gradient axis of D and inclination"),
      text("flow.flow_axis", "\"x\"", {"x", "y", "z"}, "direction of the flow"),
      real_above("flow.reynolds_number", "", 0, "", "Re = g a^2/nu, a of the first capsule; or wall_speed"),
      real_above("flow.wall_speed", "", 0, "lattice",
                 "U0 = g L/2 (poiseuille: undisturbed centre speed); or reynolds_number"),
      real_above("flow.shear_rate", "", 0, "lattice", "g of a periodic box: it sets the units only"),
      real_above("flow.relaxation_time", "1.0", 0.5, "steps", "tau+ = 1/2 + 3 nu"),
      text("flow.collision", "\"trt\"", {"trt", "bgk"}, "two relaxation times, or one"),
      real_above("flow.magic_parameter", "0.1875", 0, "", "Lambda = (tau+ - 1/2)(tau- - 1/2), trt only"),
      real_above("flow.viscosity_ratio", "1.0", 0, "", "lambda = mu_i/mu_o"),
      text("flow.start", "\"rest\"", {"rest", "developed"},
           "fluid at rest, or the steady profile without capsules"),
      list("flow.body_force", Kind::reals3, "[0.0, 0.0, 0.0]", -infinity, "lattice",
           "force on each node, added"),
      boolean("flow.inertia", "true", "false: Stokes flow, no quadratic terms"),
      real_above("flow.speed_limit", "0.3", 0, "lattice", "a higher fluid speed stops the run"),
  };
}

std::vector<Key> capsule_keys() {
  return {
      real_above("capsule.N.radius", "required", 0, "grid steps", "undeformed radius a"),
      list("capsule.N.position", Kind::reals3, "required", -infinity, "grid steps",
           "centre; the box goes from 0 to flow.box"),
      text("capsule.N.mesh.shape", "\"sphere\"", {"sphere"}, "shape made by the program"),
      integer("capsule.N.mesh.level", "3", 0, 8, "", "20 * 4^level triangles"),
      text("capsule.N.mesh.file", "", {},
           "a closed surface (.vtu) in its place, scaled to the radius by its volume"),
      real_above("capsule.N.viscosity_ratio", "flow.viscosity_ratio", 0, "", "lambda of this capsule"),
  };
}

/// Keys of [membrane]; the same, under capsule.N, lay over them.
std::vector<Key> membrane_keys(const std::string& prefix) {
  return {
      text(prefix + "elastic_law", "\"skalak\"", {"skalak", "neo-hookean", "hookean", "interfacial-tension"},
           "the membrane's law"),
      real_above(prefix + "capillary_number", "required", 0, "", "Ca = mu_o g a/modulus; not beside [si]"),
      text(prefix + "capillary_modulus", "by the law", {"E_s", "G_s", "gamma"},
           "the modulus of Ca: E_s (default of skalak), G_s (of neo-hookean, hookean), gamma (of "
           "interfacial-tension)"),
      real_from(prefix + "area_ratio", "1.0", 0, "", "C = E_a/E_s, skalak only"),
      {prefix + "poisson_ratio", Kind::real, "0.5", -0.999, 0.999, true, {}, "", "nu_s, hookean only"},
      text(prefix + "viscous.scheme", "\"none\"", {"none"}, "membrane viscosity: schemes are to come"),
  };
}

std::vector<Key> other_keys() {
  return {
      text("coupler.kernel", "\"cosine4\"", {"cosine4", "roma3", "peskin4", "linear2"},
           "discrete delta (docs/kernels.md)"),
      real_from("run.shear_time", "10.0", 0, "shear times", "end of the run"),
      integer("run.threads", "0", 0, 1024, "", "OpenMP threads; 0: all"),
      real_above("run.checkpoint_every", "1.0", 0, "shear times", "between checkpoints"),
      real_from("output.observables_every", "0.02", 0, "shear times",
                "between rows of observables.csv; 0: never"),
      real_from("output.membrane_every", "0.25", 0, "shear times", "between membrane files; 0: never"),
      real_from("output.fluid_every", "1.0", 0, "shear times", "between fluid files; 0: never"),
      list("output.fluid_box", Kind::ranges3, "", 0, "nodes",
           "[[x0, x1], [y0, y1], [z0, z1]], first and last node of fluid files; a slice has x0 = x1"),
      real_above("si.radius_m", "required", 0, "m", "radius of the first capsule"),
      real_above("si.shear_rate_per_s", "required", 0, "1/s", "g"),
      real_above("si.viscosity_Pa_s", "required", 0, "Pa s", "mu_o"),
      real_above("si.density_kg_per_m3", "1000.0", 0, "kg/m^3", "of the fluid"),
      real_above("si.shear_modulus_N_per_m", "", 0, "N/m", "G_s; or interfacial_tension_N_per_m"),
      real_above("si.interfacial_tension_N_per_m", "", 0, "N/m", "gamma; or shear_modulus_N_per_m"),
  };
}

std::vector<Key> make_schema() {
  std::vector<Key> keys = {text("title", "\"\"", {}, "what the case is")};
  for (const auto& group : {flow_keys(), capsule_keys(), membrane_keys("membrane."),
                            membrane_keys("capsule.N.membrane."), other_keys()}) {
    keys.insert(keys.end(), group.begin(), group.end());
  }
  return keys;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string range_text(const Key& key) {
  if (key.least == -infinity && key.greatest == infinity) return "";
  if (key.greatest == infinity) return fmt::format(" {} {}", key.least_included ? ">=" : ">", key.least);
  return fmt::format(" from {} to {}", key.least, key.greatest);
}

}  // namespace

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = make_schema();
  return keys;
}

std::string general_path(const std::string& path) {
  static const std::regex number("^capsule\\.[0-9]+(\\.|$)");
  return std::regex_replace(path, number, "capsule.N$1");
}

const Key* find_key(const std::string& path) {
  const auto wanted = general_path(path);
  for (const auto& key : schema()) {
    if (key.path == wanted) return &key;
  }
  return nullptr;
}

std::string allowed_text(const Key& key) {
  switch (key.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer" + range_text(key);
    case Kind::real:
      return "a number" + range_text(key);
    case Kind::integers3:
      return "three integers" + range_text(key);
    case Kind::reals3:
      return "three numbers" + range_text(key);
    case Kind::ranges3:
      return "three pairs of integers [first, last]" + range_text(key);
    case Kind::text:
      break;
  }
  if (key.choices.empty()) return "text";
  std::string choices;
  for (const auto& choice : key.choices) choices += (choices.empty() ? "" : ", ") + choice;
  return "one of " + choices;
}

std::string nearest_spelling(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = word.size() / 3 + 1;
  for (const auto& candidate : candidates) {
    const auto distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string schema_markdown() {
  std::string table = "| key | default | allowed | unit | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const auto& key : schema()) {
    if (key.path.starts_with("capsule.N.membrane."))
      continue;  // the same as membrane.*, said once in the text
    table += fmt::format("| {} | {} | {} | {} | {} |\n", key.path, key.preset, allowed_text(key), key.unit,
                         key.meaning);
  }
  return table;
}

}  // namespace tanktread::driver
