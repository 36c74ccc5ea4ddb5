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

/// The numbers of one component, a lane a node, from three packs that hold 3 numbers a node.
template <int component>
inline Pack<double> component_of(Pack<double> a, Pack<double> b, Pack<double> c) {
  constexpr int n = pack_size<double>;
  // Lane k is number 3 k + component; those of a and b first (a lane beyond them is filled by any).
  constexpr auto in_first_two = [](int k) { return 3 * k + component < 2 * n ? 3 * k + component : 0; };
  constexpr auto in_all = [](int k) {
    return 3 * k + component < 2 * n ? k : 3 * k + component - n;  // n + lane of c
  };
  return [&]<int... k>(std::integer_sequence<int, k...>) {
    const Pack<double> ab = __builtin_shufflevector(a, b, in_first_two(k)...);
    return __builtin_shufflevector(ab, c, in_all(k)...);
  }
  (std::make_integer_sequence<int, n>{});
}

/// The vectors of a pack of nodes, a pack a component.
inline PackForce<double> vectors_at(const double* numbers) {
  constexpr int n = pack_size<double>;
  const Pack<double> a = load(numbers), b = load(numbers + n), c = load(numbers + 2 * n);
  return {component_of<0>(a, b, c), component_of<1>(a, b, c), component_of<2>(a, b, c)};
}

inline Pack<float> joined(Pack<double> low, Pack<double> high) {
  using Half = float __attribute__((vector_size(pack_bytes / 2)));
  const Half first = __builtin_convertvector(low, Half), second = __builtin_convertvector(high, Half);
  return [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return __builtin_shufflevector(first, second, lane...);
  }
  (std::make_integer_sequence<int, pack_size<float>>{});
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
  const auto low = with_body(vectors_at(added));
  if constexpr (pack_size<Real> == pack_size<double>) {
    return low;
  } else {
    const auto high = with_body(vectors_at(added + 3 * pack_size<double>));
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
