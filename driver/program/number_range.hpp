// What a number may be, for keys and options alike.
#pragma once

#include <limits>
#include <string>

namespace tanktread::driver {

/// All numbers between two bounds. Neither infinity nor NaN is ever in it.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool least_included = true;  ///< the bounds belong to the range
  bool greatest_included = true;

  bool contains(double value) const;
  /// " >= 4 and <= 100", with a space before; "" if there is no bound.
  std::string text() const;
};

inline NumberRange positive() {
  return {.least = 0, .least_included = false};
}
inline NumberRange at_least(double least) {
  return {.least = least};
}
inline NumberRange between(double least, double greatest) {
  return {.least = least, .greatest = greatest};
}

}  // namespace tanktread::driver
