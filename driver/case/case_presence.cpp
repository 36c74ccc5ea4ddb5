#include "driver/case/case_checks.hpp"

namespace tanktread::driver {
namespace {

/// A capsule's key may stand in [membrane] instead.
bool stands_somewhere(const CaseReader& reader, const Key& key, std::size_t capsule) {
  if (reader.has(numbered_path(key.path, capsule))) return true;
  const std::string own = "capsule.N.";
  return key.path.starts_with(own + "membrane.") && reader.has(key.path.substr(own.size()));
}

std::string objection_of(const Key& key, const Case& the_case, std::size_t capsule) {
  return key.objection == nullptr ? "" : key.objection(the_case, capsule);
}

void check_missing(CaseReader& reader, const Key& key, const Case& the_case, std::size_t capsule) {
  if (!key.is_required() || stands_somewhere(reader, key, capsule)) return;
  if (!objection_of(key, the_case, capsule).empty()) return;
  reader.problem(numbered_path(key.path, capsule), "is missing; give " + allowed_text(key));
}

/// A value that is wrong by itself has been said to be.
void check_objection(CaseReader& reader, const Key& key, const Case& the_case, std::size_t capsule) {
  const auto path = numbered_path(key.path, capsule);
  if (!is_given(reader.value(path)) || reader.is_idle(path, key)) return;
  const auto objection = objection_of(key, the_case, capsule);
  if (!objection.empty()) reader.problem(path, objection);
}

/// A key of [membrane] has its place if it has one in any capsule.
void check_membrane_objection(CaseReader& reader, const Key& key, const Case& the_case) {
  if (!is_given(reader.value(key.path)) || reader.is_idle(key.path, key)) return;
  std::string first;
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    const auto objection = objection_of(key, the_case, k);
    if (objection.empty()) return;
    if (first.empty()) first = objection;
  }
  if (!first.empty()) reader.problem(key.path, first);
}

}  // namespace

void check_presence(CaseReader& reader, const Case& the_case) {
  if (reader.n_capsules() == 0) reader.problem("capsule", "is missing; give at least one [[capsule]]");
  for (const auto& key : schema()) {
    if (is_membrane_key(key)) {
      check_membrane_objection(reader, key, the_case);
    } else if (is_capsule_key(key)) {
      for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
        check_missing(reader, key, the_case, k);
        check_objection(reader, key, the_case, k);
      }
    } else if (!key.path.starts_with("si.") || the_case.si) {
      check_missing(reader, key, the_case, 0);
      check_objection(reader, key, the_case, 0);
    }
  }
}

}  // namespace tanktread::driver
