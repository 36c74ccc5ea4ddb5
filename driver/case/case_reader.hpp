// A TOML document read by the schema: every key known, of its type and in its range; all problems said
// together.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "driver/case/assignment.hpp"
#include "driver/case/schema.hpp"

namespace tanktread::driver {

class CaseReader {
 public:
  /// Parses, lays the assignments over it and checks every key by itself. Problems are kept, not thrown, but
  /// for a syntax error. @throws InputError
  CaseReader(const std::string& text, const std::string& name, const std::vector<std::string>& assignments);

  /// The value of a key by its path (with the capsule's number); nothing where the file has none, or none
  /// that the schema allows (then that is a problem already).
  Value value(const std::string& path) const;

  /// A default that the file spells out, as an echo does, beside assignments to other keys: if those leave it
  /// without a place, it says nothing that would contradict them.
  bool is_idle(const std::string& path, const Key& key) const;

  /// Something stands at that path, key or table.
  bool has(const std::string& path) const { return static_cast<bool>(at(path)); }
  std::size_t n_capsules() const;

  /// Notes a problem with a key: "file:line: key = value: what".
  void problem(const std::string& path, const std::string& what);
  bool has_problems() const { return !problems_.empty(); }
  /// @throws InputError with all problems, if there are any
  void finish() const;

 private:
  toml::node_view<const toml::node> at(const std::string& path) const;
  void assign(const std::string& text);
  /// Notes an assignment to [membrane] that every capsule overrides.
  void check_effect(const Assignment& assignment);
  void check_table(const toml::table& table, const std::string& prefix);
  void check_capsules(const toml::node& node);
  void check_entry(const toml::node& node, const std::string& path);
  void check_value(const toml::node& node, const std::string& path, const Key& key);
  std::string place_of(const std::string& path) const;
  const Assignment* assignment_to(const std::string& path) const;
  void note(const std::string& line);

  std::string name_;
  toml::table document_;
  std::vector<Assignment> assignments_;
  std::vector<std::string> problems_;
};

}  // namespace tanktread::driver
