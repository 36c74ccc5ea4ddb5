// Where the capsules of a case lie: distances that its checks and its warnings look at.
#pragma once

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// The axis has walls at its ends; else it is periodic.
bool has_walls(const Case& the_case, int axis);

/// Only of a sphere does the radius say where the membrane is; a mesh from a file is checked by the coupler.
bool is_sphere(const CapsuleCase& capsule);

/// From the sphere of `radius` to the nearer wall (negative: beyond it), or to its periodic image, grid
/// steps.
double gap_along(const Case& the_case, const CapsuleCase& capsule, int axis);

/// Distance of two centres, to the nearest periodic image, grid steps.
double distance_between(const Case& the_case, const CapsuleCase& a, const CapsuleCase& b);

}  // namespace tanktread::driver
