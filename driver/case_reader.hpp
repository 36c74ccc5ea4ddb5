// A TOML document read by the schema: every key known, of its type and in its range; all problems said
// together.
#pragma once

#include <toml++/toml.h>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "driver/schema.hpp"

namespace tanktread::driver {

class CaseReader {
 public:
  /// Parses, lays the assignments over it and checks every key by itself. Problems are kept, not thrown, but
  /// for a syntax error. @throws InputError
  CaseReader(const std::string& text, const std::string& name, const std::vector<std::string>& assignments);

  /// Values by path, empty where the file has none (or none of the right kind: then it is a problem already).
  std::optional<bool> boolean(const std::string& path) const;
  std::optional<int> integer(const std::string& path) const;
  std::optional<double> real(const std::string& path) const;
  std::optional<std::string> text(const std::string& path) const;
  std::optional<std::array<int, 3>> integers3(const std::string& path) const;
  std::optional<std::array<double, 3>> reals3(const std::string& path) const;
  std::optional<std::array<std::array<int, 2>, 3>> ranges3(const std::string& path) const;

  /// A key stands in the file or was set.
  bool has(const std::string& path) const { return static_cast<bool>(at(path)); }
  int n_capsules() const;

  /// Notes a problem with a key: "file:line: key = value: what".
  void problem(const std::string& path, const std::string& what);
  bool has_problems() const { return !problems_.empty(); }
  /// @throws InputError with all problems, if there are any
  void finish() const;

 private:
  toml::node_view<const toml::node> at(const std::string& path) const;
  void assign(const std::string& assignment);
  void check_table(const toml::table& table, const std::string& prefix);
  void check_unknown(const toml::node& node, const std::string& path);
  void check_value(const toml::node& node, const std::string& path, const Key& key);
  bool fits(const toml::node& node, const Key& key) const;

  std::string name_;
  toml::table document_;
  std::vector<std::string> problems_;
};

}  // namespace tanktread::driver
