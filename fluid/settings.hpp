// Checks of the settings and what follows from them, shared by the fast and the plain solver. Internal to
// fluid/.
#pragma once

#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// Throws std::invalid_argument naming the setting, its value, the allowed range.
void check(const LatticeBoltzmannSettings& settings);

/// The same for a part of a box that has this shape.
void check(const GridPart& part, const GridShape& box);

/// tau- from tau+: Lambda/(tau+ - 1/2) + 1/2, or tau+ itself for the single-rate model.
double odd_relaxation_time(const LatticeBoltzmannSettings& settings, double relaxation_time);

}  // namespace tanktread::fluid
