// The schema of the case file: one table of keys. The reader, --set, the hints, the echo and the manual all
// use it.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace tanktread::driver {

/// What a key holds.
enum class Kind { boolean, integer, real, text, integers3, reals3, ranges3 };

/// One key. In `path` a capsule's number is written N: "capsule.N.radius".
struct Key {
  std::string path;
  Kind kind;
  std::string preset;  ///< the default as it would stand in a file, or "required", or "" (none)
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool least_included = true;
  std::vector<std::string> choices;  ///< of a text; empty: any
  std::string unit;
  std::string meaning;  ///< one line
};

const std::vector<Key>& schema();

/// The key of that path (a capsule's number may stand for N), or null.
const Key* find_key(const std::string& path);

/// A path with capsule numbers replaced by N.
std::string general_path(const std::string& path);

/// "a number > 0.5", "one of trt, bgk", "three integers >= 4": what a key may hold.
std::string allowed_text(const Key& key);

/// The candidate closest in spelling (edit distance at most a third of the length), or "".
std::string nearest_spelling(const std::string& word, const std::vector<std::string>& candidates);

/// The table of keys as it stands in docs/case-file.md.
std::string schema_markdown();

}  // namespace tanktread::driver
