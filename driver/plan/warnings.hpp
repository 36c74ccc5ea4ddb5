// What a user should know before a run that is allowed, but perhaps not wise.
#pragma once

#include <string>
#include <vector>

#include "driver/system/placement.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Warnings a user should read before a run, each a sentence with the number, the bound and the key to
/// change: Mach > 0.1, tau+ outside 0.55 to 2, Re > 1 with inertia, a wall faster than the speed limit; mesh
/// edge outside 0.5 to 2 grid steps; a drop whose mesh is sheared so long that D is off by over 2 %; less
/// than a radius to a wall or a periodic image of its own, less than two kernel half-widths between capsules
/// (surface to surface); membrane viscosity beside a program in the membrane's place, or that is given but
/// switched off, or on but zero, whose update interval is too long for its spring, or whose spring is too
/// stiff for an explicit update; output intervals that rounding to whole steps changes by more than 1 %.
/// @param mean_edges mean mesh edge of each capsule, grid steps; empty: not known
/// @param placement of the membranes at the start
std::vector<std::string> warnings(const Case& the_case, const Parameters& parameters,
                                  const std::vector<double>& mean_edges, const Placement& placement);

}  // namespace tanktread::driver
