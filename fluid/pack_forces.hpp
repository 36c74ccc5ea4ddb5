// The forces on the nodes of a pack, from the list of 3 numbers a node. Internal to fluid/.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "fluid/collision.hpp"
#include "fluid/force_field.hpp"

namespace tanktread::fluid {

/// Whether one of `n` numbers is not zero.
inline __attribute__((always_inline)) bool any_force(const double* numbers, int n) {
  // One OR a number in place of a jump a number: the bits without the sign are zero only if all numbers are.
  std::uint64_t bits = 0;
  for (int k = 0; k < n; ++k) bits |= std::bit_cast<std::uint64_t>(numbers[k]) << 1;
  return bits != 0;
}

/// Eight numbers of one component, from three packs that hold 3 numbers a node.
template <int component>
inline Pack<double> component_of(Pack<double> a, Pack<double> b, Pack<double> c) {
  // Lane k is number 3 k + component; those of a and b first (a lane beyond them is filled by any).
  constexpr auto in_first_two = [](int k) { return 3 * k + component < 16 ? 3 * k + component : 0; };
  constexpr auto in_all = [](int k) {
    return 3 * k + component < 16 ? k : 8 + 3 * k + component - 16;  // 8 + lane of c
  };
  return [&]<int... k>(std::integer_sequence<int, k...>) {
    const Pack<double> ab = __builtin_shufflevector(a, b, in_first_two(k)...);
    return __builtin_shufflevector(ab, c, in_all(k)...);
  }
  (std::make_integer_sequence<int, 8>{});
}

/// The vectors of eight nodes, a pack a component.
inline PackForce<double> eight_vectors(const double* numbers) {
  const Pack<double> a = load(numbers), b = load(numbers + 8), c = load(numbers + 16);
  return {component_of<0>(a, b, c), component_of<1>(a, b, c), component_of<2>(a, b, c)};
}

inline Pack<float> joined(Pack<double> low, Pack<double> high) {
  using Half = float __attribute__((vector_size(pack_bytes / 2)));
  const Half first = __builtin_convertvector(low, Half), second = __builtin_convertvector(high, Half);
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// The total force on the pack of `n_lanes` nodes that begins with `node`; on lanes beyond it is of no
/// meaning. It is summed in double precision, whatever the lattice's numbers are.
template <typename Real>
PackForce<Real> total_force(const ForceField& field, std::int64_t node, int n_lanes) {
  constexpr int n_numbers = 3 * pack_size<Real>;
  double numbers[n_numbers];
  const double* added = field.added_to(node);
  if (n_lanes < pack_size<Real>) {
    std::fill(std::copy_n(added, 3 * n_lanes, numbers), numbers + n_numbers, 0.0);
    added = numbers;
  }
  const auto& body = field.body();
  const auto with_body = [&](const PackForce<double>& force) {
    return PackForce<double>{force.x + body[0], force.y + body[1], force.z + body[2]};
  };
  const auto low = with_body(eight_vectors(added));
  if constexpr (pack_size<Real> == 8) {
    return low;
  } else {
    const auto high = with_body(eight_vectors(added + 24));
    return {joined(low.x, high.x), joined(low.y, high.y), joined(low.z, high.z)};
  }
}

/// The first `n` lanes of a force, zero in the others.
template <typename Real>
PackForce<Real> first_lanes(const PackForce<Real>& force, int n) {
  return {first_lanes(force.x, n), first_lanes(force.y, n), first_lanes(force.z, n)};
}

/// The body force alone.
template <typename Real>
PackForce<Real> body_force(const ForceField& field) {
  const auto& body = field.body();
  return {pack_of(static_cast<Real>(body[0])), pack_of(static_cast<Real>(body[1])),
          pack_of(static_cast<Real>(body[2]))};
}

}  // namespace tanktread::fluid
