// Where the capsules of a case have room: what is the same for a sphere, which is known by its radius, and
// for another mesh, which is known when it has been made or read (driver/system/placement.hpp).
#pragma once

#include <optional>
#include <string>

#include "driver/case/case.hpp"

namespace tanktread::driver {

/// The axis has walls at its ends; else it is periodic.
bool has_walls(const Case& the_case, int axis);

/// Its membrane starts as a sphere of its radius, not as another shape or a mesh from a file.
bool is_sphere(const CapsuleCase& capsule);

/// Its stress-free shape is another than the mesh that it starts as.
bool has_own_stress_free_shape(const CapsuleCase& capsule);

/// How far a membrane reaches down and up an axis from the position of its capsule, grid steps.
struct Extent {
  double below = 0, above = 0;
};
Extent extent_of_sphere(const CapsuleCase& capsule);

/// From a membrane to the nearer wall, grid steps; negative: beyond it.
double gap_to_walls(const Case& the_case, const CapsuleCase& capsule, int axis, const Extent& extent);

/// What stands against a key of the case.
struct Objection {
  std::string path;  ///< "capsule.0.position"
  std::string what;  ///< what is wrong, the numbers and the fix
};
/// A membrane is nearer to a wall than the kernel reaches (where the kernel is known), or as long as the way
/// to its own periodic image; nothing: it has room along that axis.
std::optional<Objection> objection_along(const Case& the_case, std::size_t number, int axis,
                                         const Extent& extent);

/// Distance of two centres, to the nearest periodic image, grid steps.
double distance_between(const Case& the_case, const CapsuleCase& a, const CapsuleCase& b);

}  // namespace tanktread::driver
