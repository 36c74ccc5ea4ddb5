// How many threads a user asks for. Internal to the coupler.
#pragma once

#include <omp.h>

#include <stdexcept>
#include <string>

namespace tanktread::coupler {

/// @param threads 0: all @throws std::invalid_argument if it is negative
inline int number_of_threads(int threads) {
  if (threads < 0) {
    throw std::invalid_argument("coupler: threads = " + std::to_string(threads) +
                                "; 0 (all) or more is needed");
  }
  return threads > 0 ? threads : omp_get_max_threads();
}

}  // namespace tanktread::coupler
