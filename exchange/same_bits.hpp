// Numbers that are equal to the last bit: NaN is itself, 0 is not -0. Internal to exchange/.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Of the numbers of two arrays, whatever these are called.
inline bool same_bits(const Array& a, const Array& b) {
  return a.components == b.components &&
         std::ranges::equal(a.values, b.values, [](double x, double y) { return same_bits(x, y); });
}

}  // namespace tanktread::exchange
