// SI values to the numbers of a case and back: the one place where they meet.
#pragma once

#include <optional>

#include "driver/case/case.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// SI values of lattice units: metres a grid step, seconds a step, newtons a lattice force.
struct SiScales {
  double length_m, time_s, force_N;
  double reynolds_number_physical;  ///< of the [si] values; the case may override it
};

/// The scales of a case; none without [si].
std::optional<SiScales> si_scales(const Case& the_case, const Parameters& parameters);

/// Re = rho g a^2/mu of the physical values.
double physical_reynolds_number(const SiCase& si);

/// From [si] to the numbers of the case, for each capsule with its own radius in metres (that of [si] times
/// its radius over the first one's): Ca = mu_o g a/G_s (or gamma), Bq_s = mu_s/(mu_o a), Bq_d = mu_d/(mu_o
/// a); and the Reynolds number, unless the case gives it (or the wall speed, or is periodic). A case without
/// [si] stays as it is.
void apply_si(Case& the_case);

/// And back, from what is run: the SI values of the first capsule that the lattice values stand for. Equal to
/// the case's [si] up to rounding but for the density, which is that of the Reynolds number that is run.
/// @param scales of `si_scales`
SiCase si_of(const Case& the_case, const Parameters& parameters, const SiScales& scales);

}  // namespace tanktread::driver
