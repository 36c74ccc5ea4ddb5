// The collision of eight nodes at once: the inner loop of the program.
#pragma once

#include <utility>

#include "fluid/d3q19.hpp"

namespace tanktread::fluid {

/// Eight doubles that go through the same arithmetic. Every node of the lattice goes through a pack, those at
/// the end of a row too, so that a node's result depends neither on its place in a row nor on the compiler's
/// choice of a loop.
using Pack = double __attribute__((vector_size(64)));
inline constexpr int pack_size = 8;

/// A pack at any address of doubles.
using UnalignedPack = double __attribute__((vector_size(64), aligned(8), may_alias));

inline Pack load(const double* address) {
  return *reinterpret_cast<const UnalignedPack*>(address);
}
inline void store(double* address, Pack pack) {
  *reinterpret_cast<UnalignedPack*>(address) = pack;
}

/// Relaxation rates w+ = 1/tau+ (even) and w- = 1/tau- (odd) of eight nodes.
struct Rates {
  Pack even, odd;
};

/// Force on eight nodes.
struct PackForce {
  Pack x, y, z;
};

/// What a thread saw: the highest speed squared, and how many nodes were at or over the limit or not finite.
struct SpeedWatch {
  Pack highest_squared = {};
  Pack n_bad = {};
};

/// c_i . v of the first direction of pair k, without the multiplications by 0 and 1 that the compiler may not
/// drop.
template <int k>
inline Pack along(Pack x, Pack y, Pack z) {
  constexpr auto c = d3q19::velocity[2 * k + 1];
  static_assert(c[0] == 1 || c[0] == 0, "the first direction of a pair never points along -x");
  if constexpr (c[0] == 1 && c[1] == 0 && c[2] == 0) return x;
  if constexpr (c[0] == 0 && c[1] == 1 && c[2] == 0) return y;
  if constexpr (c[0] == 0 && c[1] == 0 && c[2] == 1) return z;
  if constexpr (c[0] == 1 && c[1] == 1) return x + y;
  if constexpr (c[0] == 1 && c[1] == -1) return x - y;
  if constexpr (c[0] == 1 && c[2] == 1) return x + z;
  if constexpr (c[0] == 1 && c[2] == -1) return x - z;
  if constexpr (c[1] == 1 && c[2] == 1) return y + z;
  if constexpr (c[1] == 1 && c[2] == -1) return y - z;
}

/// The populations of eight nodes.
using PackPopulations = Pack[d3q19::n_directions];

/// Collides eight nodes: f[i] comes in along direction i; put(i, pack) takes what goes out along the opposite
/// of i, as soon as it is known (it need not be held in a register), to where the in-place update wants it
/// (AA pattern).
///
/// Populations are differences from rest, f_i - w_i. With j = sum f_i c_i + F/2 and u = j/rho (Guo et al.
/// 2002):
///   even: f^eq+ = w (rho - 1 + rho (9/2 (c.u)^2 - 3/2 u^2)),   F^+ = w (-3 u.F + 9 (c.u)(c.F))
///   odd:  f^eq- = 3 w c.j,                                      F^- = 3 w c.F
/// Without inertia the quadratic terms and F^+ are left out and the velocity is j (reference density 1).
template <bool inertia, bool forced, typename Put>
inline __attribute__((always_inline)) void collide(const PackPopulations& f, const Rates& rates,
                                                   const PackForce& force, double limit_squared,
                                                   SpeedWatch& watch, const Put& put) {
  Pack density_change = f[0];
  for (int i = 1; i < d3q19::n_directions; ++i) density_change += f[i];
  // The order of the pairs below is that of d3q19::velocity.
  Pack jx = (f[1] - f[2]) + (f[7] - f[8]) + (f[9] - f[10]) + (f[11] - f[12]) + (f[13] - f[14]);
  Pack jy = (f[3] - f[4]) + (f[7] - f[8]) - (f[9] - f[10]) + (f[15] - f[16]) + (f[17] - f[18]);
  Pack jz = (f[5] - f[6]) + (f[11] - f[12]) - (f[13] - f[14]) + (f[15] - f[16]) - (f[17] - f[18]);
  if constexpr (forced) {
    jx += 0.5 * force.x;
    jy += 0.5 * force.y;
    jz += 0.5 * force.z;
  }

  Pack inverse_density = {1, 1, 1, 1, 1, 1, 1, 1};
  if constexpr (inertia) inverse_density /= (1.0 + density_change);
  const Pack j_squared = jx * jx + jy * jy + jz * jz;
  const Pack speed_squared = j_squared * inverse_density * inverse_density;
  const auto good = speed_squared < limit_squared;  // false for NaN too
  watch.n_bad += good ? Pack{} : Pack{} + 1.0;
  watch.highest_squared = speed_squared > watch.highest_squared ? speed_squared : watch.highest_squared;

  Pack even_base = density_change;            // rho - 1 - 3/2 rho u^2
  Pack quadratic{};                           // 9/2 / rho
  Pack force_even_base{}, force_quadratic{};  // (1 - w+/2) times -3 u.F and 9/rho
  Pack force_odd{};                           // 3 (1 - w-/2)
  if constexpr (inertia) {
    even_base -= 1.5 * j_squared * inverse_density;
    quadratic = 4.5 * inverse_density;
  }
  if constexpr (forced) {
    force_odd = 3.0 - 1.5 * rates.odd;
    if constexpr (inertia) {
      const Pack factor = 1.0 - 0.5 * rates.even;
      force_even_base = -3.0 * factor * inverse_density * (jx * force.x + jy * force.y + jz * force.z);
      force_quadratic = 9.0 * factor * inverse_density;
    }
  }

  {
    constexpr double w = d3q19::weight(0);
    Pack change = rates.even * (w * even_base - f[0]);
    if constexpr (forced && inertia) change += w * force_even_base;
    put(0, f[0] + change);
  }
  const auto collide_pair = [&]<int k>() {
    constexpr int first = 2 * k + 1, second = 2 * k + 2;
    constexpr double w = d3q19::weight(first);
    const Pack cj = along<k>(jx, jy, jz);
    const Pack even = 0.5 * (f[first] + f[second]);
    const Pack odd = 0.5 * (f[first] - f[second]);
    Pack even_equilibrium = even_base;
    if constexpr (inertia) even_equilibrium += quadratic * cj * cj;
    Pack even_change = rates.even * (w * even_equilibrium - even);
    Pack odd_change = rates.odd * ((3.0 * w) * cj - odd);
    if constexpr (forced) {
      const Pack cF = along<k>(force.x, force.y, force.z);
      odd_change += w * (force_odd * cF);
      if constexpr (inertia) even_change += w * (force_even_base + force_quadratic * cj * cF);
    }
    put(second, f[first] + (even_change + odd_change));
    put(first, f[second] + (even_change - odd_change));
  };
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (collide_pair.template operator()<k>(), ...);
  }
  (std::make_integer_sequence<int, d3q19::n_pairs>{});
}

}  // namespace tanktread::fluid
