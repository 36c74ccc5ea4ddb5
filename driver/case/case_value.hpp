// A value of the case file, of any kind a key may hold, and its text in TOML.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace tanktread::driver {

/// First and last index (both included) along x, y, z.
using Ranges3 = std::array<std::array<int, 2>, 3>;

/// Nothing (the key is absent), or what the key holds. The alternatives stand in the order of `Kind`.
using Value = std::variant<std::monostate, bool, int, double, std::string, std::array<int, 3>,
                           std::array<double, 3>, Ranges3, std::vector<std::string>>;

/// What a key holds.
enum class Kind { none, boolean, integer, real, text, integers3, reals3, ranges3, texts };

/// There is a value.
inline bool is_given(const Value& value) {
  return value.index() != 0;
}

/// The value as it stands in a file; a real number has the fewest digits that read back to the same double,
/// and always a point or an exponent, so that it stays a real number. Nothing gives "".
std::string toml_text(const Value& value);

}  // namespace tanktread::driver
