// How fast memory can be updated in place: what bounds a fluid step that has little to compute. It knows
// nothing of a run, so that the benchmarks use it too.
#pragma once

#include <cstdint>

namespace tanktread::driver {

/// Bytes per second at which all threads together load every number of an array and store it again, the best
/// of several passes: 8 read and 8 written a number, which is multiplied by one on the way.
/// @param n_numbers of the array, which it makes and takes away again
/// @param n_passes at most
/// @param seconds after which no further pass begins
/// @param threads 0: as many as OpenMP offers
/// @return 0 where memory is not enough
double update_in_place_speed(std::int64_t n_numbers, int n_passes, double seconds, int threads = 0);

}  // namespace tanktread::driver
