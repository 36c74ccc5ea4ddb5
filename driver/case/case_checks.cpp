#include "driver/case/case_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>

namespace tanktread::driver {
namespace {

void check_flow(CaseReader& reader, const Case& the_case) {
  const auto& flow = the_case.flow;
  if (flow.wall_axis == flow.flow_axis) {
    reader.problem("flow.flow_axis",
                   fmt::format("is the wall axis too ({}), but the flow runs along the walls; choose another "
                               "flow_axis or wall_axis",
                               "xyz"[flow.wall_axis]));
  }
  if (flow.kind == "periodic") {
    if (flow.start == "developed") {
      reader.problem("flow.start", "a periodic box has no developed profile; use \"rest\"");
    }
    if (!reader.has("flow.shear_rate")) {
      reader.problem("flow.shear_rate", "is missing; a periodic box needs it as its unit of time");
    }
  } else if (!reader.has("flow.reynolds_number") && !reader.has("flow.wall_speed") && !the_case.si) {
    reader.problem("flow.reynolds_number", "is missing; give reynolds_number or wall_speed");
  }
}

void check_modulus(CaseReader& reader, const Case& the_case, std::size_t capsule) {
  if (the_case.si) return;  // it gives the modulus itself
  const auto& [law, modulus] = std::pair(the_case.capsules[capsule].membrane.elastic_law,
                                         the_case.capsules[capsule].membrane.capillary_modulus);
  // E_s and G_s are one another's.
  const auto kind = [](const std::string& name) { return name == "E_s" ? std::string("G_s") : name; };
  if (kind(modulus) == kind(preset_modulus(law))) return;
  reader.problem(membrane_path(reader, "capillary_modulus", capsule),
                 fmt::format("contradicts elastic_law = \"{}\" of capsule {}, which has none; give \"{}\"",
                             law, capsule, preset_modulus(law)));
}

/// Of the three forms of a spring, as many as `least` to one.
void check_spring(CaseReader& reader, std::size_t capsule, const std::string& suffix, int least) {
  const std::string table = "viscous.spring_";
  int n_given = 0;
  for (const char* form : {"stiffness", "relaxation_time", "modulus"}) {
    if (reader.has(membrane_path(reader, table + form + suffix, capsule))) ++n_given;
  }
  if (n_given >= least && n_given <= 1) return;
  // Where there is none to point at, the scheme asks for it.
  const auto spring = membrane_path(reader, table + "stiffness" + suffix, capsule);
  reader.problem(
      n_given > 0 ? spring : membrane_path(reader, "viscous.scheme", capsule),
      fmt::format("give {} one of spring_stiffness{}, spring_relaxation_time{}, spring_modulus{} ({} given)",
                  least == 1 ? "exactly" : "at most", suffix, suffix, suffix, n_given));
}

/// An implicit force needs an answer from the fluid that a program is not asked for.
void check_implicit(CaseReader& reader, const Case& the_case, std::size_t capsule) {
  const auto& membrane = the_case.capsules[capsule].membrane;
  if (membrane.viscous.scheme != implicit_scheme || !membrane.command.empty() ||
      the_case.flow.command.empty())
    return;
  reader.problem(
      membrane_path(reader, "viscous.scheme", capsule),
      "contradicts flow.command: an implicit force needs the velocity of its own time without it, which a "
      "program in the place of the fluid is not asked for; use \"fd\" with a spring");
}

void check_viscous(CaseReader& reader, const Case& the_case, std::size_t capsule) {
  const auto& viscous = the_case.capsules[capsule].membrane.viscous;
  check_spring(reader, capsule, "_dilatational", 0);
  const bool needs_spring = viscous.scheme != "none" && viscous.scheme != implicit_scheme;
  check_spring(reader, capsule, "", needs_spring ? 1 : 0);
  check_implicit(reader, the_case, capsule);
  // A modulus k_s' alone gives no relaxation time for the dilatational spring to take over.
  const bool takes_over = !viscous.spring_stiffness_dilatational &&
                          !viscous.spring_relaxation_time_dilatational &&
                          !viscous.spring_modulus_dilatational;
  if (viscous.scheme != "none" && viscous.boussinesq_shear == 0 && viscous.boussinesq_dilatational > 0 &&
      viscous.spring_modulus && takes_over) {
    reader.problem(membrane_path(reader, "viscous.spring_modulus", capsule),
                   "is that of the shear spring, but boussinesq_shear is 0 and so is its relaxation time; "
                   "give spring_modulus_dilatational, or spring_relaxation_time");
  }
}

/// A spheroid needs one number that says which; of two, each key's objection says that.
template <typename Part>
void check_spheroid(CaseReader& reader, const Part& part, const std::string& table) {
  if (!part.file.empty() || part.shape != "spheroid") return;
  if (reader.has(table + "aspect_ratio") || reader.has(table + "reduced_volume")) return;
  reader.problem(table + "shape", "needs aspect_ratio or reduced_volume beside it; give one of them");
}

/// Shapes of the program share triangles; a file has its own.
void check_shapes(CaseReader& reader, const Case& the_case, std::size_t number) {
  const auto& [mesh, stress_free] =
      std::tie(the_case.capsules[number].mesh, the_case.capsules[number].stress_free);
  const auto mesh_table = fmt::format("capsule.{}.mesh.", number);
  const auto stress_free_table = fmt::format("capsule.{}.stress_free.", number);
  check_spheroid(reader, mesh, mesh_table);
  check_spheroid(reader, stress_free, stress_free_table);
  if (mesh.direction && *mesh.direction == std::array<double, 3>{0, 0, 0})
    reader.problem(mesh_table + "direction", "has no length, so it points nowhere; give another");
  if (!mesh.file.empty() && stress_free.file.empty() && stress_free.shape != "mesh") {
    reader.problem(stress_free_table + "shape",
                   "has not the triangles of mesh.file, only those of mesh.shape; give stress_free.file, or "
                   "mesh.shape in place of mesh.file");
  }
}

template <typename Part>
void check_file(CaseReader& reader, const Part& part, const std::string& path) {
  if (part.file.empty() || std::filesystem::is_regular_file(part.file)) return;
  reader.problem(
      path, fmt::format(
                "there is no file {}; {}", part.file,
                part.file_hash.empty()
                    ? "a relative path starts at the case file's folder"
                    : fmt::format("if it was moved, give its new path: what it holds is held against {}_hash",
                                  path)));
}

void check_load(CaseReader& reader, const Case& the_case, std::size_t capsule) {
  if (the_case.capsules[capsule].load.direction != std::array<double, 3>{0, 0, 0}) return;
  reader.problem(fmt::format("capsule.{}.load.direction", capsule),
                 "has the length 0; give a vector along the axis that is pulled, of any length");
}

/// A key of an energy of the whole membrane, and that in its place in [si].
struct EnergyKey {
  const char* name;
  double EnergyCase::*value;
  const char* si_path;
  std::optional<double> SiCase::*in_si;
};

constexpr EnergyKey energy_keys[] = {
    {"bending_modulus", &EnergyCase::bending_modulus, "si.bending_modulus_J", &SiCase::bending_modulus_J},
    {"global_area_modulus", &EnergyCase::global_area_modulus, "si.global_area_modulus_N_per_m",
     &SiCase::global_area_modulus_N_per_m},
    {"local_area_modulus", &EnergyCase::local_area_modulus, "si.local_area_modulus_N_per_m",
     &SiCase::local_area_modulus_N_per_m},
    {"volume_modulus", &EnergyCase::volume_modulus, "si.volume_modulus_N_per_m2",
     &SiCase::volume_modulus_N_per_m2},
};

/// A program in the place of the laws gives all forces.
void check_energies_of_program(CaseReader& reader, const Case& the_case, std::size_t capsule) {
  const auto& membrane = the_case.capsules[capsule].membrane;
  if (membrane.command.empty()) return;
  for (const auto& key : energy_keys) {
    const double value = the_case.si ? (*the_case.si.*key.in_si).value_or(0) : membrane.energy.*key.value;
    if (value == 0) continue;
    reader.problem(the_case.si ? key.si_path : membrane_path(reader, key.name, capsule),
                   fmt::format("contradicts membrane.command of capsule {}: the program gives all forces of "
                               "the membrane, those of energies too; remove it",
                               capsule));
  }
  if (membrane.elastic_law != no_elastic_law) return;
  reader.problem(membrane_path(reader, "elastic_law", capsule),
                 fmt::format("contradicts membrane.command of capsule {}: a program is given the moduli of a "
                             "law, and \"none\" has none; give the law whose moduli it takes",
                             capsule));
}

void check_capsule(CaseReader& reader, const Case& the_case, std::size_t number) {
  check_shapes(reader, the_case, number);
  check_modulus(reader, the_case, number);
  check_viscous(reader, the_case, number);
  check_load(reader, the_case, number);
  check_energies_of_program(reader, the_case, number);
}

/// [si] of capsules without an elastic law: their modulus is that of bending.
void check_si_without_law(CaseReader& reader, const SiCase& si) {
  for (const char* modulus : {"si.shear_modulus_N_per_m", "si.interfacial_tension_N_per_m"}) {
    if (reader.has(modulus))
      reader.problem(modulus, "contradicts elastic_law = \"none\", which has none; remove it");
  }
  if (si.bending_modulus_J.value_or(0) > 0) return;
  reader.problem("si.bending_modulus_J",
                 fmt::format("{}; elastic_law = \"none\" needs it as its modulus: give a number above 0",
                             si.bending_modulus_J ? "is 0" : "is missing"));
}

bool has_law(const CapsuleCase& capsule) {
  return capsule.membrane.elastic_law != no_elastic_law;
}

void check_si(CaseReader& reader, const Case& the_case) {
  if (!the_case.si) return;
  if (!the_case.capsules.empty() && std::ranges::none_of(the_case.capsules, has_law))
    return check_si_without_law(reader, *the_case.si);
  const bool has_modulus = reader.has("si.shear_modulus_N_per_m");
  const bool has_tension = reader.has("si.interfacial_tension_N_per_m");
  if (has_modulus == has_tension) {
    reader.problem("si.shear_modulus_N_per_m",
                   fmt::format("give exactly one of shear_modulus_N_per_m (a capsule) and "
                               "interfacial_tension_N_per_m (a droplet); {} given",
                               has_modulus ? 2 : 0));
    return;
  }
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& law = the_case.capsules[k].membrane.elastic_law;
    if (!has_law(the_case.capsules[k])) {
      reader.problem(
          membrane_path(reader, "elastic_law", k),
          fmt::format("is \"none\" in capsule {}, beside capsules with a law: [si] has one modulus "
                      "for all; give the numbers of each capsule instead of [si]",
                      k));
      return;
    }
    const bool is_tension = law == "interfacial-tension";
    if (is_tension == has_tension) continue;
    reader.problem(has_tension ? "si.interfacial_tension_N_per_m" : "si.shear_modulus_N_per_m",
                   fmt::format("contradicts elastic_law = \"{}\" of capsule {}; give {} in its place", law, k,
                               is_tension ? "interfacial_tension_N_per_m" : "shear_modulus_N_per_m"));
    return;
  }
}

}  // namespace

std::string membrane_path(const CaseReader& reader, const std::string& name, std::size_t capsule) {
  const auto shared = "membrane." + name;
  const auto own = fmt::format("capsule.{}.{}", capsule, shared);
  return reader.has(own) || !reader.has(shared) ? own : shared;
}

std::string preset_modulus(const std::string& elastic_law) {
  if (elastic_law == "skalak") return "E_s";
  if (elastic_law == no_elastic_law) return "kappa_b";
  return elastic_law == "interfacial-tension" ? "gamma" : "G_s";
}

void check_mesh_files(CaseReader& reader, const Case& the_case) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto& capsule = the_case.capsules[k];
    check_file(reader, capsule.mesh, fmt::format("capsule.{}.mesh.file", k));
    check_file(reader, capsule.stress_free, fmt::format("capsule.{}.stress_free.file", k));
  }
}

void check_consistency(CaseReader& reader, const Case& the_case) {
  check_flow(reader, the_case);
  check_si(reader, the_case);
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) check_capsule(reader, the_case, k);
}

}  // namespace tanktread::driver
