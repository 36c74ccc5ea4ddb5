// The bandwidth of this machine's memory, measured in the run whose results are held against it.
#pragma once

namespace tanktread::bench {

/// Bytes per second, the best of several passes over arrays much larger than the caches, on as many threads
/// as OpenMP offers. Every pass counts 16 bytes a double: 8 read and 8 written (a plain copy makes the
/// processor read the target too; that is not counted, as in STREAM).
struct Bandwidth {
  double plain_copy = 0.0;         ///< b[i] = a[i], ordinary stores
  double non_temporal_copy = 0.0;  ///< the same, stores that go past the caches; 0 where there are none
  double in_place = 0.0;           ///< a[i] = s a[i]: what an update in place can reach at most

  /// The faster of the two copies: the yardstick.
  double copy() const { return plain_copy > non_temporal_copy ? plain_copy : non_temporal_copy; }
};

/// Measured at the first call (a few seconds).
const Bandwidth& measured_bandwidth();

/// What a benchmark's main does: measures the bandwidth, writes it and the number of threads above the
/// results, runs the benchmarks. @return the exit status
int run(int argc, char** argv);

}  // namespace tanktread::bench
