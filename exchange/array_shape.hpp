// What the index of a grid or surface in pieces says of an array that each of them has.
#pragma once

#include <string>

namespace tanktread::exchange {

/// An array that every piece has, of doubles.
struct ArrayShape {
  std::string name;
  int components = 1;
  bool operator==(const ArrayShape&) const = default;
};

}  // namespace tanktread::exchange
