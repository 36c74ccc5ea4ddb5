// How near two triangles in space are.
#pragma once

#include <Eigen/Core>

namespace tanktread::membrane {

/// Where two things are nearest to each other.
struct NearestPlace {
  double distance = 0;    ///< in the unit of the points; 0: they cut through each other
  Eigen::Vector3d place;  ///< midway between the two nearest points, or where they cut
};

/// Of two triangles. Where they only touch, the distance is 0 up to rounding.
/// @param a, b corners as columns
NearestPlace nearest_place(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace tanktread::membrane
