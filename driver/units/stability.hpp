// Where the explicit update of the viscous stress breaks down.
#pragma once

#include <string>

namespace tanktread::driver {

/// The largest N k' (interval times spring, lattice units) that is safely stable, in units of mu_o, by
/// kernel, without or with the tangential correction, by which a node moves further under the same force. A
/// spring of stiffness k' that is held for N steps moves a node by N k' e/mu_o times a length of the kernel;
/// beyond a number it comes back further than it went. The onset is measured for each kernel, with a capsule
/// of 9.5 grid steps and one viscosity (docs/viscous-membranes.md; with stockie6 it is above the limit for
/// viscosity ratios from 0.05 to 20 too, without the correction from 0.2 to 5); half of it is taken, for
/// where wrinkles grow a run breaks down below the onset from rest. Of a kernel that is not in the list, the
/// least of all.
double stable_interval_times_spring(const std::string& kernel, bool tangential_correction);

}  // namespace tanktread::driver
