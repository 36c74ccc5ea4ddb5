// The collision of a pack of nodes at once: the inner loop of the program. Internal to fluid/.
#pragma once

#include <array>
#include <utility>

#include "fluid/d3q19.hpp"
#include "fluid/pack.hpp"

namespace tanktread::fluid {

/// Relaxation rates w+ = 1/tau+ (even) and w- = 1/tau- (odd) of the nodes of a pack.
template <typename Real>
struct Rates {
  Pack<Real> even, odd;
};

/// Force on the nodes of a pack.
template <typename Real>
struct PackForce {
  Pack<Real> x, y, z;
};

/// What a thread saw: the highest speed squared, and how many nodes were at or over the limit or not finite.
template <typename Real>
struct SpeedWatch {
  Pack<Real> highest_squared = {};
  Pack<Real> n_bad = {};
};

/// c_i . v of the first direction of pair k, without the multiplications by 0 and 1 that the compiler may not
/// drop.
template <int k, typename Vector>
inline Vector along(Vector x, Vector y, Vector z) {
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

/// The populations of the nodes of a pack.
template <typename Real>
using PackPopulations = Pack<Real>[d3q19::n_directions];

/// Sum over all directions. In single precision by pairs, which collide() needs anyway, and pairs of pairs:
/// it rounds less and waits less. In double precision one after the other, as the results of earlier
/// versions.
template <typename Real>
inline __attribute__((always_inline)) Pack<Real> sum_of(const PackPopulations<Real>& f) {
  if constexpr (sizeof(Real) == sizeof(float)) {
    const auto pair = [&](int k) __attribute__((always_inline)) {
      return f[2 * k + 1] + f[2 * k + 2];
    };
    return (f[0] + ((pair(0) + pair(1)) + (pair(2) + pair(3)))) +
           (((pair(4) + pair(5)) + (pair(6) + pair(7))) + pair(8));
  } else {
    Pack<Real> sum = f[0];
#pragma GCC unroll 19
    for (int i = 1; i < d3q19::n_directions; ++i) sum += f[i];
    return sum;
  }
}

/// sum f_i c_i. The order of the pairs is that of d3q19::velocity.
template <typename Real>
inline __attribute__((always_inline)) std::array<Pack<Real>, 3> momentum_of(const PackPopulations<Real>& f) {
  return {(f[1] - f[2]) + (f[7] - f[8]) + (f[9] - f[10]) + (f[11] - f[12]) + (f[13] - f[14]),
          (f[3] - f[4]) + (f[7] - f[8]) - (f[9] - f[10]) + (f[15] - f[16]) + (f[17] - f[18]),
          (f[5] - f[6]) + (f[11] - f[12]) - (f[13] - f[14]) + (f[15] - f[16]) - (f[17] - f[18])};
}

/// Collides the nodes of a pack: f[i] comes in along direction i; put(i, pack) takes what goes out along the
/// opposite of i, as soon as it is known (it need not be held in a register) and in the order of the
/// directions that go out, to where the in-place update wants it (AA pattern).
///
/// Populations are differences from rest, f_i - w_i. With j = sum f_i c_i + F/2 and u = j/rho (Guo et al.
/// 2002):
///   even: f^eq+ = w (rho - 1 + rho (9/2 (c.u)^2 - 3/2 u^2)),   F^+ = w (-3 u.F + 9 (c.u)(c.F))
///   odd:  f^eq- = 3 w c.j,                                      F^- = 3 w c.F
/// Without inertia the quadratic terms and F^+ are left out and the velocity is j (reference density 1).
///
/// All of it is made part of the caller's loop by force: as functions of their own the pairs would fetch what
/// they share from memory for each pack, which takes twice the instructions.
template <bool inertia, bool forced, typename Real, typename Put>
inline __attribute__((always_inline)) void collide(const PackPopulations<Real>& f, const Rates<Real>& rates,
                                                   const PackForce<Real>& force, Real limit_squared,
                                                   SpeedWatch<Real>& watch, const Put& put) {
  using Numbers = Pack<Real>;
  constexpr Real one = 1, half = 0.5;
  const Numbers density_change = sum_of<Real>(f);
  const auto momentum = momentum_of<Real>(f);
  Numbers jx = momentum[0], jy = momentum[1], jz = momentum[2];
  if constexpr (forced) {
    jx += half * force.x;
    jy += half * force.y;
    jz += half * force.z;
  }

  Numbers inverse_density = pack_of(one);
  if constexpr (inertia) inverse_density /= (one + density_change);
  const Numbers j_squared = jx * jx + jy * jy + jz * jz;
  const Numbers speed_squared = j_squared * inverse_density * inverse_density;
  const auto good = speed_squared < pack_of(limit_squared);  // false for NaN too
  watch.n_bad += good ? Numbers{} : pack_of(one);
  watch.highest_squared = speed_squared > watch.highest_squared ? speed_squared : watch.highest_squared;

  Numbers even_base = density_change;            // rho - 1 - 3/2 rho u^2
  Numbers quadratic{};                           // 9/2 / rho
  Numbers force_even_base{}, force_quadratic{};  // (1 - w+/2) times -3 u.F and 9/rho
  Numbers force_odd{};                           // 3 (1 - w-/2)
  if constexpr (inertia) {
    even_base -= Real(1.5) * j_squared * inverse_density;
    quadratic = Real(4.5) * inverse_density;
  }
  if constexpr (forced) {
    force_odd = Real(3) - Real(1.5) * rates.odd;
    if constexpr (inertia) {
      const Numbers factor = one - half * rates.even;
      force_even_base = Real(-3) * factor * inverse_density * (jx * force.x + jy * force.y + jz * force.z);
      force_quadratic = Real(9) * factor * inverse_density;
    }
  }

  {
    constexpr Real w = d3q19::weight(0);
    Numbers change = rates.even * (w * even_base - f[0]);
    if constexpr (forced && inertia) change += w * force_even_base;
    put(0, f[0] + change);
  }
  const auto collide_pair = [&]<int k>() __attribute__((always_inline)) {
    constexpr int first = 2 * k + 1, second = 2 * k + 2;
    constexpr Real w = d3q19::weight(first), three_w = 3.0 * d3q19::weight(first);
    const Numbers cj = along<k>(jx, jy, jz);
    const Numbers even = half * (f[first] + f[second]);
    const Numbers odd = half * (f[first] - f[second]);
    Numbers even_equilibrium = even_base;
    if constexpr (inertia) even_equilibrium += quadratic * cj * cj;
    Numbers even_change = rates.even * (w * even_equilibrium - even);
    Numbers odd_change = rates.odd * (three_w * cj - odd);
    if constexpr (forced) {
      const Numbers cF = along<k>(force.x, force.y, force.z);
      odd_change += w * (force_odd * cF);
      if constexpr (inertia) even_change += w * (force_even_base + force_quadratic * cj * cF);
    }
    put(second, f[first] + (even_change + odd_change));
    put(first, f[second] + (even_change - odd_change));
  };
  [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
    (collide_pair.template operator()<k>(), ...);
  }
  (std::make_integer_sequence<int, d3q19::n_pairs>{});
}

}  // namespace tanktread::fluid
