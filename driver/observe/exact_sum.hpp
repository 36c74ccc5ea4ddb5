// Sums of doubles that do not depend on the order of their terms.
#pragma once

#include <array>
#include <cstdint>

namespace tanktread::driver {

/// A sum without rounding: a fixed-point number wide enough for every double (Kulisch 1971). It is the same
/// however its terms are ordered, and shared among threads and ranks; only value() rounds, once. Its bytes
/// can be sent.
class ExactSum {
 public:
  /// Infinite terms and NaN are summed as doubles are, and are all that value() tells then.
  void add(double term);
  /// All terms of another sum.
  void add(const ExactSum& other);
  /// The double nearest to the sum, of two equally near the even one; infinite beyond the range of doubles.
  double value() const;

 private:
  /// Puts into each limb 32 bits of the sum, and its sign into the last one.
  void carry();

  // Limb k counts units of 2^(32 k - 1074). 2098 bits hold any double, those above them as many terms as can
  // ever be added. A limb has room for 2^29 terms before it must pass on what is more than its 32 bits.
  static constexpr int n_limbs = 68;
  std::array<std::int64_t, n_limbs> limbs_{};
  std::int64_t n_uncarried_ = 0;
  double not_finite_ = 0;
};

/// The sum of term(k) for k = 0 to n - 1, by some OpenMP threads, whose number does not change it.
template <class Term>
ExactSum exact_sum(std::int64_t n, int threads, const Term& term) {
  ExactSum sum;
#pragma omp parallel num_threads(threads)
  {
    ExactSum of_thread;
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) of_thread.add(term(k));
#pragma omp critical(tanktread_exact_sum)
    sum.add(of_thread);
  }
  return sum;
}

}  // namespace tanktread::driver
