// Sums of products whose roundings do not depend on the compiler. Internal to the coupler.
#pragma once

#include <cmath>

namespace tanktread::coupler {

/// a b + c, rounded once where the processor can. Said by hand where there are two products: of a b - c d a
/// compiler may round either once more, and decides so by the loop around it.
inline double multiply_add(double a, double b, double c) {
#ifdef FP_FAST_FMA
  return std::fma(a, b, c);
#else
  return a * b + c;
#endif
}

inline double dot(const double* a, const double* b) {
  return multiply_add(a[2], b[2], multiply_add(a[0], b[0], a[1] * b[1]));
}

}  // namespace tanktread::coupler
