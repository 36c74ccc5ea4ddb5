// The schema of the case file: one table of keys. The reader, --set, the hints, the range checks, the echo of
// the case and the manual all use it.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/case/case_value.hpp"
#include "driver/program/number_range.hpp"

namespace tanktread::driver {

/// One key: what it may hold, and which member of the case it is. In `path` a capsule's number is written N:
/// "capsule.N.radius". The functions take that number; keys outside `capsule` do not look at it.
struct Key {
  std::string path;
  Kind kind = Kind::none;
  std::string preset;  ///< the default as it would stand in a file; "required"; words; or "" (none)
  NumberRange range;
  std::vector<std::string> choices;  ///< of a text; empty: any
  std::string unit;                  ///< "" for a pure number or a word
  std::string meaning;               ///< one line
  /// A run may go on from a checkpoint with another value: its state does not depend on the key. By itself a
  /// key may not.
  bool may_change_on_resume = false;

  /// The member's value; nothing if it has none.
  Value (*get)(const Case& the_case, std::size_t capsule) = nullptr;
  void (*set)(Case& the_case, std::size_t capsule, const Value& value) = nullptr;
  /// Why the key has no place in such a case ("contradicts ...", with the fix), or "". It is then refused in
  /// a file and left out of an echo. Null: it always has.
  std::string (*objection)(const Case& the_case, std::size_t capsule) = nullptr;

  bool is_required() const { return preset == "required"; }
};

/// All keys, in the order of the manual.
const std::vector<Key>& schema();

/// The key of that path (a capsule's number may stand for N), or null.
const Key* find_key(const std::string& path);

/// A path with the capsule's number replaced by N: "capsule.2.radius" becomes "capsule.N.radius".
std::string general_path(const std::string& path);
/// The other way.
std::string numbered_path(const std::string& path, std::size_t capsule);

/// A key of [membrane] holds for each capsule whose own table does not override it.
bool is_membrane_key(const Key& key);
bool is_capsule_key(const Key& key);

/// "a number > 0.5", "one of "trt", "bgk"", "three integers >= 4": what a key may hold.
std::string allowed_text(const Key& key);

/// What a path that is no key was perhaps meant to be: a key or table of nearly that spelling in the same
/// table, the same name in another table, or "".
std::string similar_path(const std::string& path);

/// The table of keys as it stands in docs/case-file.md.
std::string schema_markdown();

}  // namespace tanktread::driver
