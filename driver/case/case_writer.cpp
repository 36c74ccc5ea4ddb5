// The case as TOML, by the schema: every key that has a place in it, with its value, unit and meaning.
#include <fmt/format.h>

#include "driver/case/case.hpp"
#include "driver/case/said_value.hpp"
#include "driver/case/schema.hpp"
#include "driver/case/toml_line.hpp"

namespace tanktread::driver {
namespace {

/// The table that a key stands in, as its heading, and the key's name in it. Tables below a capsule are
/// written as dotted names, so that each capsule is one block.
struct Heading {
  std::string heading, name;
};

Heading heading_of(const Key& key) {
  const auto dot = key.path.find('.');
  if (dot == std::string::npos) return {"", key.path};
  if (is_capsule_key(key)) return {"[[capsule]]", key.path.substr(std::string("capsule.N.").size())};
  return {fmt::format("[{}]", key.path.substr(0, dot)), key.path.substr(dot + 1)};
}

void put_key(std::string& toml, const std::string& name, const Key& key, const Case& the_case,
             std::size_t capsule) {
  const auto value = said_value(key, the_case, capsule);
  if (!is_given(value)) return;
  auto comment = key.meaning;
  if (!key.unit.empty()) comment = fmt::format("{}; {}", key.unit, comment);
  toml += toml_line(name, value, comment);
}

/// Whether a capsule's key says what [membrane] or [flow] says already.
bool is_said_above(const Key& key, const Case& the_case, std::size_t capsule) {
  const Key* above = find_key(heading_of(key).name);
  if (above != nullptr) return is_shared(*above, the_case);
  return key.path == "capsule.N.viscosity_ratio" &&
         the_case.capsules[capsule].viscosity_ratio == the_case.flow.viscosity_ratio;
}

void put_capsule(std::string& toml, const Case& the_case, std::size_t capsule) {
  toml += "\n[[capsule]]\n";
  for (const auto& key : schema()) {
    if (!is_capsule_key(key) || is_said_above(key, the_case, capsule)) continue;
    put_key(toml, heading_of(key).name, key, the_case, capsule);
  }
}

}  // namespace

std::string to_toml(const Case& the_case) {
  std::string toml = "# Written by tanktread: the case with every key resolved. It reproduces the run.\n";
  std::string last_heading;
  bool capsules_are_written = false;
  for (const auto& key : schema()) {
    if (is_capsule_key(key)) {  // a block a capsule, where the first of their keys stands
      for (std::size_t k = 0; !capsules_are_written && k < the_case.capsules.size(); ++k) {
        put_capsule(toml, the_case, k);
      }
      capsules_are_written = true;
      continue;
    }
    if (is_membrane_key(key) && !is_shared(key, the_case)) continue;
    if (!the_case.si && key.path.starts_with("si.")) continue;
    const auto [heading, name] = heading_of(key);
    if (heading != last_heading) toml += fmt::format("\n{}\n", heading);
    last_heading = heading;
    put_key(toml, name, key, the_case, 0);
  }
  return toml;
}

}  // namespace tanktread::driver
