// From the SI values of a case to its dimensionless numbers.
#pragma once

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// Re = rho g a^2/mu of the physical values.
double physical_reynolds_number(const SiCase& si);

/// From [si] to the numbers of the case, for each capsule with its own radius in metres (that of [si] times
/// its radius over the first one's): Ca = mu_o g a/G_s (or gamma; without a law kappa_b/a^2), Bq_s =
/// mu_s/(mu_o a), Bq_d = mu_d/(mu_o a), energies and load.force in units of the same modulus (EnergyCase,
/// LoadCase); and the Reynolds number, unless the case gives it (or the wall speed, or is periodic). A case
/// without [si] stays as it is.
void apply_si(Case& the_case);

}  // namespace tanktread::driver
