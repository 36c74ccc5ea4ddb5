// Where the explicit update of the viscous stress breaks down.
#pragma once

namespace tanktread::driver {

/// The largest N k' (interval times spring, lattice units) that is safely stable, in units of mu_o: 32. A
/// spring of stiffness k' that is held for N steps moves a node by N k' e/mu_o times a length of the kernel;
/// beyond a number it comes back further than it went. The number is measured, with the kernel cosine4 and a
/// capsule of 9.5 grid steps, by bisection (docs/viscous-membranes.md): the onset lies at 48 to 70 for N of 5
/// and more, and for N = 1 as soon as Bq is 40; a softer dashpot at N = 1 stands more. That is from rest,
/// over 150 updates: where wrinkles grow a run at 44.6 broke down later, one at 31.8 did not. With the
/// tangential correction a node moves further under the same force: the onset lies between 9 and 24, by
/// kernel and mesh, and 6 is taken.
inline double stable_interval_times_spring(bool tangential_correction) {
  return tangential_correction ? 6 : 32;
}

}  // namespace tanktread::driver
