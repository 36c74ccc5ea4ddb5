#include "driver/case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "driver/case/case_checks.hpp"
#include "driver/case/case_programs.hpp"
#include "driver/case/case_reader.hpp"
#include "driver/case/names.hpp"
#include "driver/case/si_numbers.hpp"

namespace tanktread::driver {
namespace {

void lay_value(Case& the_case, std::size_t capsule, const Key& key, const Value& value) {
  if (is_given(value)) key.set(the_case, capsule, value);
}

/// A capsule may inherit from [membrane] what its own law does not take (that it has is no problem); and what
/// it has no place for, an echo does not say. So it keeps the default.
void forget_what_has_no_place(Case& the_case, std::size_t capsule) {
  Case defaults;
  defaults.capsules.emplace_back();
  for (const auto& key : schema()) {
    if (!is_capsule_key(key) || key.objection == nullptr) continue;
    if (!key.objection(the_case, capsule).empty()) key.set(the_case, capsule, key.get(defaults, 0));
  }
}

/// What the file says, over the defaults. [membrane] goes into each capsule, then the capsule's own table.
Case case_of(const CaseReader& reader) {
  Case the_case;
  the_case.capsules.resize(reader.n_capsules());
  if (reader.has("si")) the_case.si.emplace();
  for (const auto& key : schema()) {
    if (!is_capsule_key(key) && !is_membrane_key(key)) lay_value(the_case, 0, key, reader.value(key.path));
  }
  if (!reader.has("coupler.tangential_correction")) {
    the_case.coupler.tangential_correction = is_corrected_by_default(the_case.coupler.kernel);
  }
  if (!reader.has("coupler.shear_dipole"))
    the_case.coupler.shear_dipole = the_case.coupler.tangential_correction;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    the_case.capsules[k].viscosity_ratio = the_case.flow.viscosity_ratio;
    for (const auto& key : schema()) {
      if (is_membrane_key(key)) lay_value(the_case, k, key, reader.value(key.path));
    }
    for (const auto& key : schema()) {
      if (is_capsule_key(key)) lay_value(the_case, k, key, reader.value(numbered_path(key.path, k)));
    }
    forget_what_has_no_place(the_case, k);
    auto& membrane = the_case.capsules[k].membrane;
    if (!reader.has(membrane_path(reader, "capillary_modulus", k))) {
      membrane.capillary_modulus = preset_modulus(membrane.elastic_law);
    }
  }
  return the_case;
}

/// Paths of mesh files are taken from the case file's folder and kept absolute, so that an echo of the case
/// can lie anywhere.
void find_mesh_files(Case& the_case, const std::filesystem::path& directory) {
  for (auto& capsule : the_case.capsules) {
    for (auto* file : {&capsule.mesh.file, &capsule.stress_free.file}) {
      if (!file->empty()) *file = std::filesystem::absolute(directory / *file).lexically_normal().string();
    }
  }
}

}  // namespace

Case parse_case(const std::string& text, const std::string& name, const std::filesystem::path& directory,
                const std::vector<std::string>& assignments, const FilesUsed& used) {
  CaseReader reader(text, name, assignments);
  auto the_case = case_of(reader);
  the_case.file = directory / std::filesystem::path(name).filename();
  find_mesh_files(the_case, directory);
  find_program_files(the_case, directory);
  check_presence(reader, the_case);
  check_consistency(reader, the_case);
  if (used.meshes) check_mesh_files(reader, the_case);
  check_programs(reader, the_case, used);
  // What follows compares and divides numbers, each of which must be right by itself first.
  if (!reader.has_problems()) check_geometry(reader, the_case);
  reader.finish();
  apply_si(the_case);
  return the_case;
}

bool has_contrast(const Case& the_case) {
  return std::ranges::any_of(the_case.capsules,
                             [](const CapsuleCase& capsule) { return capsule.viscosity_ratio != 1; });
}

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& assignments,
               const FilesUsed& used) {
  if (std::filesystem::is_directory(file)) {
    const auto echo = file / "echo.toml";
    throw InputError(fmt::format("{}: is a folder, not a case file; give the path of a .toml{}",
                                 file.string(),
                                 std::filesystem::exists(echo) ? ", as " + echo.string() : ""));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file) || !stream) {
    throw InputError(fmt::format(
        "{}: there is no such case file, or it cannot be read; give the path of a .toml", file.string()));
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_case(text.str(), file.string(), std::filesystem::absolute(file).parent_path(), assignments,
                    used);
}

}  // namespace tanktread::driver
