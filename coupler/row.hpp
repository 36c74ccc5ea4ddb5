// A row of a stencil: the numbers of neighbouring grid nodes, taken through the same arithmetic in vectors.
#pragma once

#include <cstring>

namespace tanktread::coupler {

/// `length` doubles that lie one after the other, at any address; in registers as long as nobody asks for
/// one of them. What is done to one is done to each, so that their results are those of a plain loop.
template <int length>
class Row {
 public:
  /// All zero.
  Row() = default;
  /// number(k) for k = 0 .. length - 1.
  template <class Number>
  __attribute__((always_inline)) explicit Row(const Number& number) {
#pragma GCC unroll 8
    for (int k = 0; k < n_fours; ++k)
      fours_[k] = Four{number(4 * k), number(4 * k + 1), number(4 * k + 2), number(4 * k + 3)};
#pragma GCC unroll 8
    for (int k = 0; k < n_twos; ++k) twos_[k] = Two{number(4 * n_fours), number(4 * n_fours + 1)};
#pragma GCC unroll 8
    for (int k = 0; k < n_ones; ++k) ones_[k] = number(length - 1);
  }

  /// Adds weight times the numbers at `source`.
  __attribute__((always_inline)) void add(double weight, const double* source) {
#pragma GCC unroll 8
    for (int k = 0; k < n_fours; ++k) add_product(weight, source + 4 * k, fours_[k]);
#pragma GCC unroll 8
    for (int k = 0; k < n_twos; ++k) add_product(weight, source + 4 * n_fours, twos_[k]);
#pragma GCC unroll 8
    for (int k = 0; k < n_ones; ++k) ones_[k] += weight * source[length - 1];
  }

  /// Adds weight times the numbers of another.
  __attribute__((always_inline)) void add(double weight, const Row& other) {
#pragma GCC unroll 8
    for (int k = 0; k < n_fours; ++k) fours_[k] += weight * other.fours_[k];
#pragma GCC unroll 8
    for (int k = 0; k < n_twos; ++k) twos_[k] += weight * other.twos_[k];
#pragma GCC unroll 8
    for (int k = 0; k < n_ones; ++k) ones_[k] += weight * other.ones_[k];
  }

  /// Adds weight times this to the numbers at `target`.
  __attribute__((always_inline)) void add_to(double weight, double* target) const {
#pragma GCC unroll 8
    for (int k = 0; k < n_fours; ++k) add_product_to(weight, fours_[k], target + 4 * k);
#pragma GCC unroll 8
    for (int k = 0; k < n_twos; ++k) add_product_to(weight, twos_[k], target + 4 * n_fours);
#pragma GCC unroll 8
    for (int k = 0; k < n_ones; ++k) target[length - 1] += weight * ones_[k];
  }

  __attribute__((always_inline)) void store_to(double* numbers) const {
#pragma GCC unroll 8
    for (int k = 0; k < n_fours; ++k) store(fours_[k], numbers + 4 * k);
#pragma GCC unroll 8
    for (int k = 0; k < n_twos; ++k) store(twos_[k], numbers + 4 * n_fours);
#pragma GCC unroll 8
    for (int k = 0; k < n_ones; ++k) numbers[length - 1] = ones_[k];
  }

 private:
  static constexpr int n_fours = length / 4, n_twos = length % 4 / 2, n_ones = length % 2;
  using Four = double __attribute__((vector_size(32)));
  using Two = double __attribute__((vector_size(16)));

  // By memcpy, for the addresses are those of doubles; no vector is passed by value, for which there is one
  // way with AVX and another without.
  template <class Vector>
  __attribute__((always_inline)) static void add_product(double weight, const double* source, Vector& sum) {
    Vector numbers;
    std::memcpy(&numbers, source, sizeof numbers);
    sum += weight * numbers;
  }
  template <class Vector>
  __attribute__((always_inline)) static void add_product_to(double weight, const Vector& vector,
                                                            double* target) {
    Vector numbers;
    std::memcpy(&numbers, target, sizeof numbers);
    store(numbers + weight * vector, target);
  }
  template <class Vector>
  __attribute__((always_inline)) static void store(const Vector& vector, double* address) {
    std::memcpy(address, &vector, sizeof vector);
  }

  Four fours_[n_fours > 0 ? n_fours : 1] = {};
  Two twos_[n_twos > 0 ? n_twos : 1] = {};
  double ones_[n_ones > 0 ? n_ones : 1] = {};
};

}  // namespace tanktread::coupler
