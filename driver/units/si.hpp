// Lattice units in SI, and from what is run back to SI (to the numbers of the case: case/si_numbers.hpp).
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

/// And back, from what is run: the SI values of the first capsule that the lattice values stand for. Equal to
/// the case's [si] up to rounding but for the density, which is that of the Reynolds number that is run.
/// @param scales of `si_scales`
SiCase si_of(const Case& the_case, const Parameters& parameters, const SiScales& scales);

}  // namespace tanktread::driver
