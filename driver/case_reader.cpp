#include "driver/case_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "driver/case.hpp"

namespace tanktread::driver {
namespace {

std::string value_text(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

bool is_index(const std::string& text) {
  return !text.empty() && text.size() < 9 && text.find_first_not_of("0123456789") == std::string::npos;
}

/// The value of an assignment: TOML, or a bare word for a text (shells eat quotes).
toml::table parse_value(const std::string& value) {
  try {
    return toml::parse("value = " + value);
  } catch (const toml::parse_error&) {
    toml::table table;
    table.insert("value", value);
    return table;
  }
}

bool number_fits(double value, const Key& key) {
  if (!std::isfinite(value)) return false;
  return (key.least_included ? value >= key.least : value > key.least) && value <= key.greatest;
}

/// An array of exactly n elements, each of which `element_fits`.
template <typename Fits>
bool array_fits(const toml::node& node, std::size_t n, const Fits& element_fits) {
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != n) return false;
  for (const auto& element : *array) {
    if (!element_fits(element)) return false;
  }
  return true;
}

bool real_fits(const toml::node& node, const Key& key) {
  return node.is_number() && number_fits(*node.value<double>(), key);
}

bool integer_fits(const toml::node& node, const Key& key) {
  return node.is_integer() && number_fits(static_cast<double>(*node.value<std::int64_t>()), key) &&
         std::abs(*node.value<double>()) < 2e9;
}

bool range_fits(const toml::node& node, const Key& key) {
  return array_fits(node, 2, [&](const toml::node& element) { return integer_fits(element, key); });
}

}  // namespace

CaseReader::CaseReader(const std::string& text, const std::string& name,
                       const std::vector<std::string>& assignments)
    : name_(name) {
  try {
    document_ = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line, error.description()));
  }
  for (const auto& assignment : assignments) assign(assignment);
  check_table(document_, "");
}

toml::node_view<const toml::node> CaseReader::at(const std::string& path) const {
  toml::node_view<const toml::node> view(document_);
  for (const auto& part : split(path)) view = is_index(part) ? view[std::stoul(part)] : view[part];
  return view;
}

void CaseReader::assign(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(
        fmt::format("--set {}: must be key=value, for example --set flow.relaxation_time=0.8", assignment));
  }
  const auto path = assignment.substr(0, equals);
  const auto value = parse_value(assignment.substr(equals + 1));
  const auto parts = split(path);
  toml::node* node = &document_;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    if (auto* table = node->as_table()) {
      if (last) {
        table->insert_or_assign(parts[k], *value.get("value"));
      } else if (!table->contains(parts[k])) {
        table->insert(parts[k], toml::table{});
      }
      node = table->get(parts[k]);
      continue;
    }
    auto* array = node->as_array();
    if (array == nullptr || !is_index(parts[k]) || std::stoul(parts[k]) >= array->size()) {
      throw InputError(fmt::format("--set {}: {} has no entry '{}' in {}{}", assignment, path, parts[k],
                                   name_,
                                   array != nullptr ? fmt::format(", only 0 to {}", array->size() - 1) : ""));
    }
    const auto index = std::stoul(parts[k]);
    if (last) array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), *value.get("value"));
    node = array->get(index);
  }
}

void CaseReader::check_table(const toml::table& table, const std::string& prefix) {
  for (const auto& [name, node] : table) {
    const std::string path = prefix + std::string(name.str());
    const Key* key = find_key(path);
    if (key != nullptr) {
      check_value(node, path, *key);
    } else if (path == "capsule") {
      const auto* capsules = node.as_array();
      if (capsules == nullptr || !capsules->is_homogeneous<toml::table>()) {
        problem(path, "must be a list of tables; write [[capsule]]");
        continue;
      }
      for (std::size_t k = 0; k < capsules->size(); ++k) {
        check_table(*capsules->get(k)->as_table(), fmt::format("capsule.{}.", k));
      }
    } else {
      check_unknown(node, path);
    }
  }
}

/// A table is known if a key lies below it.
void CaseReader::check_unknown(const toml::node& node, const std::string& path) {
  std::vector<std::string> paths;
  bool is_prefix = false;
  for (const auto& key : schema()) {
    paths.push_back(key.path);
    is_prefix = is_prefix || key.path.starts_with(general_path(path) + ".");
  }
  if (is_prefix && node.is_table()) {
    check_table(*node.as_table(), path + ".");
    return;
  }
  if (is_prefix) {
    problem(path, "must be a table");
    return;
  }
  const auto hint = nearest_spelling(general_path(path), paths);
  problem(path, "unknown key; " + (hint.empty() ? std::string("remove it (docs/case-file.md lists all)")
                                                : "did you mean " + hint + "?"));
}

bool CaseReader::fits(const toml::node& node, const Key& key) const {
  switch (key.kind) {
    case Kind::boolean:
      return node.is_boolean();
    case Kind::integer:
      return integer_fits(node, key);
    case Kind::real:
      return real_fits(node, key);
    case Kind::text:
      return node.is_string() &&
             (key.choices.empty() || std::find(key.choices.begin(), key.choices.end(),
                                               *node.value<std::string>()) != key.choices.end());
    case Kind::integers3:
      return array_fits(node, 3, [&](const toml::node& element) { return integer_fits(element, key); });
    case Kind::reals3:
      return array_fits(node, 3, [&](const toml::node& element) { return real_fits(element, key); });
    case Kind::ranges3:
      return array_fits(node, 3, [&](const toml::node& element) { return range_fits(element, key); });
  }
  return false;
}

void CaseReader::check_value(const toml::node& node, const std::string& path, const Key& key) {
  if (fits(node, key)) return;
  std::string what = "must be " + allowed_text(key);
  if (node.is_string() && !key.choices.empty()) {
    const auto hint = nearest_spelling(*node.value<std::string>(), key.choices);
    if (!hint.empty()) what += "; did you mean \"" + hint + "\"?";
  }
  if (!key.preset.empty() && key.preset != "required") what += " (default " + key.preset + ")";
  problem(path, what);
}

void CaseReader::problem(const std::string& path, const std::string& what) {
  const auto view = at(path);
  std::string place = name_, value;
  if (view) {
    const auto line = view.node()->source().begin.line;
    if (line > 0) place += fmt::format(":{}", line);
    if (!view.is_table()) value = " = " + value_text(*view.node());
  }
  problems_.push_back(fmt::format("{}: {}{}: {}", place, path, value, what));
}

void CaseReader::finish() const {
  if (problems_.empty()) return;
  std::string message;
  for (const auto& line : problems_) message += (message.empty() ? "" : "\n") + line;
  throw InputError(message);
}

int CaseReader::n_capsules() const {
  const auto* capsules = at("capsule").as_array();
  return capsules == nullptr ? 0 : static_cast<int>(capsules->size());
}

namespace {

/// The node if it is what the schema says of it.
template <typename Value, typename Convert>
std::optional<Value> read(toml::node_view<const toml::node> view, bool fits, const Convert& convert) {
  if (!view || !fits) return std::nullopt;
  return convert(*view.node());
}

std::array<int, 3> to_integers(const toml::node& node) {
  const auto& array = *node.as_array();
  return {*array.get(0)->value<int>(), *array.get(1)->value<int>(), *array.get(2)->value<int>()};
}

}  // namespace

std::optional<bool> CaseReader::boolean(const std::string& path) const {
  const auto view = at(path);
  return read<bool>(view, view && fits(*view.node(), *find_key(path)),
                    [](const toml::node& n) { return *n.value<bool>(); });
}
std::optional<int> CaseReader::integer(const std::string& path) const {
  const auto view = at(path);
  return read<int>(view, view && fits(*view.node(), *find_key(path)),
                   [](const toml::node& n) { return *n.value<int>(); });
}
std::optional<double> CaseReader::real(const std::string& path) const {
  const auto view = at(path);
  return read<double>(view, view && fits(*view.node(), *find_key(path)),
                      [](const toml::node& n) { return *n.value<double>(); });
}
std::optional<std::string> CaseReader::text(const std::string& path) const {
  const auto view = at(path);
  return read<std::string>(view, view && fits(*view.node(), *find_key(path)),
                           [](const toml::node& n) { return *n.value<std::string>(); });
}
std::optional<std::array<int, 3>> CaseReader::integers3(const std::string& path) const {
  const auto view = at(path);
  return read<std::array<int, 3>>(view, view && fits(*view.node(), *find_key(path)), to_integers);
}
std::optional<std::array<double, 3>> CaseReader::reals3(const std::string& path) const {
  const auto view = at(path);
  return read<std::array<double, 3>>(
      view, view && fits(*view.node(), *find_key(path)), [](const toml::node& n) {
        const auto& array = *n.as_array();
        return std::array<double, 3>{*array.get(0)->value<double>(), *array.get(1)->value<double>(),
                                     *array.get(2)->value<double>()};
      });
}
std::optional<std::array<std::array<int, 2>, 3>> CaseReader::ranges3(const std::string& path) const {
  const auto view = at(path);
  using Ranges = std::array<std::array<int, 2>, 3>;
  return read<Ranges>(view, view && fits(*view.node(), *find_key(path)), [](const toml::node& n) {
    Ranges ranges;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& range = *n.as_array()->get(axis)->as_array();
      ranges[axis] = {*range.get(0)->value<int>(), *range.get(1)->value<int>()};
    }
    return ranges;
  });
}

}  // namespace tanktread::driver
