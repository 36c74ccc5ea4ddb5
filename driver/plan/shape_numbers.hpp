// What the echo says of the shapes of a capsule in numbers.
#pragma once

#include "driver/system/capsule_shape.hpp"

namespace tanktread::driver {

/// Of the triangles, not of the surface that they are chords of. All 0: not known.
struct ShapeNumbers {
  double mean_edge = 0;                                       ///< grid steps
  double area = 0;                                            ///< grid steps squared
  double reduced_volume = 0, stress_free_reduced_volume = 0;  ///< membrane::reduced_volume()
};

ShapeNumbers shape_numbers(const CapsuleShape& shape);

}  // namespace tanktread::driver
