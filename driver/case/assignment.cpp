#include "driver/case/assignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

#include "driver/case/case_value.hpp"
#include "driver/case/key_depth.hpp"
#include "driver/case/schema.hpp"

namespace tanktread::driver {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::optional<std::size_t> index_of(const std::string& text) {
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::stoul(text);
}

/// A table of one entry "value", or none if it is not TOML, or TOML with keys of very many parts.
std::optional<toml::table> parse_value(const std::string& value) {
  if (line_of_deep_key(value)) return std::nullopt;
  try {
    auto table = toml::parse("value = " + value);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
  }
  return std::nullopt;
}

std::optional<toml::table> value_of(const Assignment& assignment) {
  const auto value = trimmed(assignment.value);
  const bool starts_as_toml = !value.empty() && std::string("\"'[{").find(value[0]) != std::string::npos;
  const Key* key = find_key(assignment.path);
  const bool wants_text = key != nullptr && key->kind == Kind::text;
  if (starts_as_toml) return parse_value(value);
  if (!wants_text) {
    if (auto table = parse_value(value)) return table;
  }
  return parse_value(toml_text(Value(value)));  // which holds it against TOML's UTF-8
}

/// What an array has, for a message: the list of capsules or an array of numbers.
std::string entries_text(const std::string& path, std::size_t n) {
  if (path == "capsule") {
    return n == 1 ? "there is 1 capsule, number 0" : fmt::format("there are {} capsules, 0 to {}", n, n - 1);
  }
  return n == 0 ? path + " is empty" : fmt::format("{} has the elements 0 to {}", path, n - 1);
}

/// The entry of a table on the way to the value, made if it is not there: a list that the schema has a
/// default for, so that one of its elements can be set; else a table.
toml::node* entry_of(toml::table& table, const std::string& name, const std::string& path) {
  if (!table.contains(name)) {
    const Key* key = find_key(path);
    const auto preset = key != nullptr ? parse_value(key->preset) : std::nullopt;
    if (preset && preset->get("value")->is_array()) {
      table.insert(name, *preset->get("value"));
    } else {
      table.insert(name, toml::table{});
    }
  }
  return table.get(name);
}

}  // namespace

Assignment split_assignment(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return {text, "", ""};
  return {text, trimmed(text.substr(0, equals)), text.substr(equals + 1)};
}

std::string lay_over(toml::table& document, const Assignment& assignment) {
  if (std::ranges::count(assignment.path, '.') >= most_key_parts)
    return fmt::format("a key of more than {} parts; no key of a case has so many", most_key_parts);
  const auto value = value_of(assignment);
  if (!value) return "the value is not valid TOML; quote texts, and quote the whole for the shell";
  const auto parts = split(assignment.path);
  toml::node* node = &document;
  std::string path;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& part = parts[k];
    const bool is_last = k + 1 == parts.size();
    const auto above = path;
    path += (path.empty() ? "" : ".") + part;
    if (auto* table = node->as_table()) {
      const Key* key = above.empty() ? nullptr : find_key(above);
      if (key != nullptr) return above + " is not in the file; set it whole, to " + allowed_text(*key);
      if (above == "capsule") return "the file has no list of capsules; write [[capsule]]";
      if (is_last) {
        table->insert_or_assign(part, *value->get("value"));
      } else {
        node = entry_of(*table, part, path);
      }
    } else if (auto* array = node->as_array()) {
      const auto index = index_of(part);
      if (!index || *index >= array->size())
        return "no '" + path + "': " + entries_text(above, array->size());
      if (is_last) {
        array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(*index), *value->get("value"));
      } else {
        node = array->get(*index);
      }
    } else {
      return above + " is a single value, it has no '" + part + "'";
    }
  }
  return "";
}

}  // namespace tanktread::driver
