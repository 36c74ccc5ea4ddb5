#include "driver/case/case_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "driver/case/key_depth.hpp"
#include "driver/case/node_value.hpp"
#include "driver/case/spelling.hpp"

namespace tanktread::driver {
namespace {

/// One path is the other, or lies below it.
bool are_related(const std::string& a, const std::string& b) {
  return a == b || a.starts_with(b + ".") || b.starts_with(a + ".");
}

std::string parent_of(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

/// The number in "capsule.2.radius"; 0 if there is none.
std::size_t capsule_of(const std::string& path) {
  return general_path(path) == path ? 0 : std::stoul(path.substr(std::string("capsule.").size()));
}

bool is_known_table(const std::string& path) {
  const auto prefix = general_path(path) + ".";
  return std::any_of(schema().begin(), schema().end(),
                     [&](const Key& key) { return key.path.starts_with(prefix); });
}

}  // namespace

CaseReader::CaseReader(const std::string& text, const std::string& name,
                       const std::vector<std::string>& assignments)
    : name_(name) {
  if (const auto line = line_of_deep_key(text)) {
    throw InputError(fmt::format("{}:{}: a key of more than {} parts; no key of a case has so many, remove it", name,
                                 *line, most_key_parts));
  }
  try {
    document_ = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const std::string_view description = error.description();
    // Without the name of the parser's constant that a limit may be said with.
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line,
                                 description.substr(0, description.find(" (TOML_"))));
  }
  for (const auto& assignment : assignments) assign(assignment);
  for (const auto& assignment : assignments_) check_effect(assignment);
  check_table(document_, "");
}

toml::node_view<const toml::node> CaseReader::at(const std::string& path) const {
  toml::node_view<const toml::node> view(document_);
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    const bool is_index = view.is_array() && part.find_first_not_of("0123456789") == std::string::npos;
    view = is_index ? view[std::stoul(part)] : view[part];
  }
  return view;
}

void CaseReader::assign(const std::string& text) {
  const auto assignment = split_assignment(text);
  if (assignment.path.empty()) {
    note(fmt::format("--set {}: write key=value, for example --set flow.relaxation_time=0.8", text));
    return;
  }
  const auto what = lay_over(document_, assignment);
  if (!what.empty()) {
    note(fmt::format("--set {}: {}", text, what));
    return;
  }
  assignments_.push_back(assignment);
}

void CaseReader::check_effect(const Assignment& assignment) {
  const Key* key = find_key(assignment.path);
  if (key == nullptr || !is_membrane_key(*key) || n_capsules() == 0) return;
  for (std::size_t k = 0; k < n_capsules(); ++k) {
    if (!at(fmt::format("capsule.{}.{}", k, assignment.path))) return;
  }
  note(fmt::format("--set {}: has no effect, for every capsule has its own; set capsule.0.{} (1 ...)",
                   assignment.text, assignment.path));
}

void CaseReader::check_table(const toml::table& table, const std::string& prefix) {
  for (const auto& [name, node] : table) {
    const std::string word(name.str());
    if (word.find('.') == std::string::npos) {
      check_entry(node, prefix + word);
    } else {
      note(fmt::format("{}:{}: {}\"{}\": unknown key; a dotted name must not be quoted", name_,
                       node.source().begin.line, prefix, word));
    }
  }
}

void CaseReader::check_entry(const toml::node& node, const std::string& path) {
  if (const Key* key = find_key(path)) {
    check_value(node, path, *key);
  } else if (path == "capsule") {
    check_capsules(node);
  } else if (is_known_table(path)) {
    if (node.is_table()) {
      check_table(*node.as_table(), path + ".");
    } else {
      problem(path, fmt::format("must be a table; write {} = {{ ... }}", path.substr(path.rfind('.') + 1)));
    }
  } else {
    const auto similar = numbered_path(similar_path(path), capsule_of(path));
    problem(path, similar.empty() ? "unknown key; remove it (docs/case-file.md lists all keys)"
                                  : "unknown key; did you mean " + similar + "?");
  }
}

void CaseReader::check_capsules(const toml::node& node) {
  const auto* capsules = node.as_array();
  const bool are_tables =
      capsules != nullptr &&
      std::all_of(capsules->begin(), capsules->end(), [](const toml::node& n) { return n.is_table(); });
  if (!are_tables) {
    problem("capsule", "must be a list of tables; write [[capsule]], with two brackets");
    return;
  }
  for (std::size_t k = 0; k < capsules->size(); ++k) {
    check_table(*capsules->get(k)->as_table(), fmt::format("capsule.{}.", k));
  }
}

void CaseReader::check_value(const toml::node& node, const std::string& path, const Key& key) {
  if (is_given(value_of(node, key))) return;
  auto what = "must be " + allowed_text(key);
  const auto* real = node.as_floating_point();
  if (real != nullptr && !std::isfinite(real->get())) what = "is not finite; " + what;
  if (const auto* text = node.as_string()) {
    const auto similar = nearest_spelling(text->get(), key.choices);
    if (!similar.empty()) what += fmt::format("; did you mean \"{}\"?", similar);
  }
  if (!key.preset.empty() && !key.is_required()) what += fmt::format(" (default {})", key.preset);
  problem(path, what);
}

Value CaseReader::value(const std::string& path) const {
  const auto view = at(path);
  const Key* key = find_key(path);
  return view && key != nullptr ? value_of(*view.node(), *key) : Value();
}

bool CaseReader::is_idle(const std::string& path, const Key& key) const {
  const auto table = [](const std::string& name) {
    const auto first = name.substr(0, name.find('.'));
    return first == "capsule" ? "membrane"
                              : first;  // a capsule's keys are those of its membrane, as far as it matters
  };
  const bool is_touched =
      std::ranges::any_of(assignments_, [&](const Assignment& a) { return table(a.path) == table(path); });
  return is_touched && assignment_to(path) == nullptr && toml_text(value(path)) == key.preset;
}

std::size_t CaseReader::n_capsules() const {
  const auto* capsules = at("capsule").as_array();
  if (capsules == nullptr) return 0;
  return static_cast<std::size_t>(
      std::count_if(capsules->begin(), capsules->end(), [](const toml::node& n) { return n.is_table(); }));
}

/// The last assignment that has set what stands at the path, or a part of it.
const Assignment* CaseReader::assignment_to(const std::string& path) const {
  const auto last = std::find_if(assignments_.rbegin(), assignments_.rend(),
                                 [&](const Assignment& a) { return are_related(a.path, path); });
  return last == assignments_.rend() ? nullptr : &*last;
}

/// "file:line" of the path, or of the nearest table above it that has a line in the file.
std::string CaseReader::place_of(const std::string& path) const {
  for (auto above = path; !above.empty(); above = parent_of(above)) {
    const auto view = at(above);
    if (view && view.node()->source().begin.line > 0) {
      return fmt::format("{}:{}", name_, view.node()->source().begin.line);
    }
  }
  return name_;
}

void CaseReader::problem(const std::string& path, const std::string& what) {
  const auto view = at(path);
  std::string place = place_of(path), subject = path;
  if (view && !view.is_table() && path != "capsule") subject += " = " + node_text(*view.node());
  const auto* assignment = view ? assignment_to(path) : nullptr;
  if (assignment != nullptr) place = "--set " + assignment->text;
  // An assignment of just this key says it and its value already.
  const bool is_said = assignment != nullptr && assignment->path == path;
  note(is_said ? fmt::format("{}: {}", place, what) : fmt::format("{}: {}: {}", place, subject, what));
}

void CaseReader::note(const std::string& line) {
  if (std::find(problems_.begin(), problems_.end(), line) == problems_.end()) problems_.push_back(line);
}

void CaseReader::finish() const {
  if (problems_.empty()) return;
  if (problems_.size() == 1) throw InputError(problems_.front());
  auto message = fmt::format("{}: {} problems", name_, problems_.size());
  for (const auto& line : problems_) message += "\n  " + line;
  throw InputError(message);
}

}  // namespace tanktread::driver
