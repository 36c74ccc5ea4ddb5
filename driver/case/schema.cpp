#include "driver/case/schema.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver/case/schema_keys.hpp"
#include "driver/case/spelling.hpp"

namespace tanktread::driver {
namespace {

const std::string capsule_prefix = "capsule.";

std::vector<Key> make_schema() {
  std::vector<Key> keys;
  for (const auto& group : {title_and_flow_keys(), capsule_keys(), membrane_keys("membrane."),
                            membrane_keys("capsule.N.membrane."), coupler_run_output_keys(), si_keys()}) {
    keys.insert(keys.end(), group.begin(), group.end());
  }
  return keys;
}

std::string choices_text(const std::vector<std::string>& choices) {
  std::string text;
  for (const auto& choice : choices) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", choice);
  return choices.size() == 1 ? text : "one of " + text;
}

/// "flow.box" -> "flow." and "box".
std::pair<std::string, std::string> split_last(const std::string& path) {
  const auto dot = path.rfind('.');
  if (dot == std::string::npos) return {"", path};
  return {path.substr(0, dot + 1), path.substr(dot + 1)};
}

/// The names that may stand in a table, its keys and its tables.
std::vector<std::string> names_below(const std::string& prefix) {
  std::vector<std::string> names;
  for (const auto& key : schema()) {
    if (!key.path.starts_with(prefix)) continue;
    const auto rest = key.path.substr(prefix.size());
    const auto name = rest.substr(0, rest.find('.'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = make_schema();
  return keys;
}

std::string general_path(const std::string& path) {
  if (!path.starts_with(capsule_prefix)) return path;
  const auto end = path.find_first_not_of("0123456789", capsule_prefix.size());
  if (end == capsule_prefix.size()) return path;  // no number there
  if (end == std::string::npos) return capsule_prefix + "N";
  return path[end] == '.' ? capsule_prefix + "N" + path.substr(end) : path;
}

std::string numbered_path(const std::string& path, std::size_t capsule) {
  if (!path.starts_with("capsule.N")) return path;
  return fmt::format("capsule.{}{}", capsule, path.substr(std::string("capsule.N").size()));
}

const Key* find_key(const std::string& path) {
  const auto wanted = general_path(path);
  for (const auto& key : schema()) {
    if (key.path == wanted) return &key;
  }
  return nullptr;
}

bool is_membrane_key(const Key& key) {
  return key.path.starts_with("membrane.");
}

bool is_capsule_key(const Key& key) {
  return key.path.starts_with(capsule_prefix);
}

std::string allowed_text(const Key& key) {
  switch (key.kind) {
    case Kind::none:
      break;
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer" + key.range.text();
    case Kind::real:
      return "a number" + key.range.text();
    case Kind::integers3:
      return "three integers" + key.range.text();
    case Kind::reals3:
      return "three numbers" + key.range.text();
    case Kind::ranges3:
      return "three pairs of integers" + key.range.text();
    case Kind::text:
      return key.choices.empty() ? "text" : choices_text(key.choices);
    case Kind::texts:
      return "a list of texts";
  }
  return "";
}

std::string similar_path(const std::string& path) {
  const auto [table, name] = split_last(general_path(path));
  const auto here = nearest_spelling(name, names_below(table));
  if (!here.empty()) return table + here;
  for (const auto& key : schema()) {
    if (split_last(key.path).second == name) return key.path;
  }
  std::vector<std::string> paths;
  for (const auto& key : schema()) paths.push_back(key.path);
  return nearest_spelling(general_path(path), paths);
}

std::string schema_markdown() {
  std::string table = "| key | default | allowed | unit | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const auto& key : schema()) {
    // The keys that override [membrane] are the same; the manual says so once.
    if (key.path.starts_with("capsule.N.membrane.")) continue;
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.path, key.preset, allowed_text(key), key.unit,
                         key.meaning);
  }
  return table;
}

}  // namespace tanktread::driver
