#include "tests/bench/bandwidth.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <string>

#include "driver/run/memory_speed.hpp"

namespace tanktread::bench {
namespace {

constexpr int n_passes = 12;
constexpr std::int64_t line = 8;  ///< doubles of a cache line

struct Release {
  void operator()(double* memory) const { ::operator delete[](memory, std::align_val_t{64}); }
};
using Array = std::unique_ptr<double[], Release>;

/// Eight times the largest cache, 256 MiB at the least, in whole lines.
std::int64_t n_doubles() {
  std::int64_t bytes = std::int64_t{256} << 20;
  for (const auto& cache : benchmark::CPUInfo::Get().caches)
    bytes = std::max<std::int64_t>(bytes, 8L * cache.size);
  return bytes / static_cast<std::int64_t>(sizeof(double)) / line * line;
}

/// Every thread touches first what it will pass over later.
Array make_array(std::int64_t n) {
  Array array(static_cast<double*>(::operator new[](sizeof(double) * n, std::align_val_t{64})));
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) array[k] = 1.0;
  return array;
}

void copy_plainly(double* target, const double* source, std::int64_t n) {
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; k += line) {
    // By lines and behind a barrier: a memcpy of the whole may choose stores past the caches by itself.
    std::memcpy(target + k, source + k, line * sizeof(double));
    asm volatile("" ::: "memory");
  }
}

#if defined(__SSE2__)
void copy_past_caches(double* target, const double* source, std::int64_t n) {
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < n; k += line) {
#if defined(__AVX512F__)
      _mm512_stream_pd(target + k, _mm512_load_pd(source + k));
#elif defined(__AVX__)
      for (std::int64_t lane = 0; lane < line; lane += 4)
        _mm256_stream_pd(target + k + lane, _mm256_load_pd(source + k + lane));
#else
      for (std::int64_t lane = 0; lane < line; lane += 2)
        _mm_stream_pd(target + k + lane, _mm_load_pd(source + k + lane));
#endif
    }
    _mm_sfence();
  }
}
#endif

/// Bytes per second of the fastest pass.
double best_of_passes(std::int64_t n, const std::function<void()>& pass) {
  double shortest = 1e300;
  for (int k = 0; k < n_passes; ++k) {
    const auto start = std::chrono::steady_clock::now();
    pass();
    shortest =
        std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 2.0 * sizeof(double) * static_cast<double>(n) / shortest;
}

Bandwidth measure() {
  const std::int64_t n = n_doubles();
  const Array source = make_array(n), target = make_array(n);
  Bandwidth bandwidth;
  bandwidth.plain_copy = best_of_passes(n, [&] { copy_plainly(target.get(), source.get(), n); });
#if defined(__SSE2__)
  bandwidth.non_temporal_copy = best_of_passes(n, [&] { copy_past_caches(target.get(), source.get(), n); });
#endif
  constexpr double no_limit = 1e9;
  bandwidth.in_place = driver::update_in_place_speed(n, n_passes, no_limit);
  benchmark::DoNotOptimize(target[n / 2]);
  return bandwidth;
}

std::string gigabytes(double bytes_per_second) {
  if (bytes_per_second == 0.0) return "none on this processor";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f GB/s", 1e-9 * bytes_per_second);
  return text;
}

}  // namespace

const Bandwidth& measured_bandwidth() {
  static const Bandwidth bandwidth = measure();
  return bandwidth;
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const Bandwidth& bandwidth = measured_bandwidth();
  benchmark::AddCustomContext("threads", std::to_string(omp_get_max_threads()));
  benchmark::AddCustomContext("copy, plain stores", gigabytes(bandwidth.plain_copy));
  benchmark::AddCustomContext("copy, non-temporal stores", gigabytes(bandwidth.non_temporal_copy));
  benchmark::AddCustomContext("update in place", gigabytes(bandwidth.in_place));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace tanktread::bench
