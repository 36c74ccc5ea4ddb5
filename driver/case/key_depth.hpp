// A look at TOML before toml++ reads it: keys of very many parts.
#pragma once

#include <optional>
#include <string_view>

namespace tanktread::driver {

/// The most parts that a dotted key may have, many more than any key of a case has. toml++ makes a table of
/// each part and takes them apart one within the other, for which the stack would not do with some ten
/// thousand.
inline constexpr int most_key_parts = 32;

/// The line (from 1) of the first dotted name of more than most_key_parts parts; none if there is none. Texts
/// and comments do not count, whatever they hold.
std::optional<int> line_of_deep_key(std::string_view toml);

}  // namespace tanktread::driver
