#include "driver/run/memory_speed.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>

namespace tanktread::driver {
namespace {

struct Release {
  void operator()(double* memory) const { ::operator delete[](memory, std::align_val_t{64}); }
};

/// Every thread touches first what it passes over later, as in the lattice.
void fill(double* array, std::int64_t n, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t k = 0; k < n; ++k) array[k] = 1.0;
}

void update(double* array, std::int64_t n, double factor, int threads) {
#pragma omp parallel for simd schedule(static) num_threads(threads)
  for (std::int64_t k = 0; k < n; ++k) array[k] *= factor;
}

}  // namespace

double update_in_place_speed(std::int64_t n_numbers, int n_passes, double seconds, int threads) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const auto start = Clock::now();
  const auto n = static_cast<std::size_t>(n_numbers);
  const std::unique_ptr<double[], Release> array(
      static_cast<double*>(::operator new[](sizeof(double) * n, std::align_val_t{64}, std::nothrow)));
  if (!array) return 0;
  if (threads == 0) threads = omp_get_max_threads();
  fill(array.get(), n_numbers, threads);
  volatile double one = 1.0;  // or the compiler would see that nothing changes
  double shortest = 0;
  for (int k = 0; k < n_passes && (k == 0 || since(start) < seconds); ++k) {
    const auto before = Clock::now();
    update(array.get(), n_numbers, one, threads);
    const double pass = since(before);
    shortest = k == 0 ? pass : std::min(shortest, pass);
  }
  return shortest > 0 ? 2.0 * sizeof(double) * static_cast<double>(n) / shortest : 0;
}

}  // namespace tanktread::driver
