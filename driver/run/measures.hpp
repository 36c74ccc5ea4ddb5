// What Chapter 4 of the thesis measures of each capsule beside its D: contour, speed along it, extent,
// marker.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "driver/system/system.hpp"

namespace tanktread::driver {

/// One row of measures.csv: one capsule at one time. The shear plane is that of flow and wall axis, the
/// vorticity axis the third; a is the radius of the capsule.
struct Measures {
  std::int64_t step = 0;
  double shear_time = 0;
  int capsule = 0;
  /// C* = C/(2 pi a), C the length of the curve in which the shear plane through the centroid of the enclosed
  /// volume cuts the membrane. Are there several curves, as of a folded membrane, C is the sum of all.
  double circumference = 0;
  /// V*, the mean along these curves of the membrane's speed in their plane, seen from the centroid, over
  /// g a. The velocity of the nodes is that which moved them to where they are, as in the membrane files.
  double membrane_speed = 0;
  double vorticity_extent = 0;  ///< greatest less least position of a node along the vorticity, over 2 a
  /// From the centroid to the marker, over a: the node that in the mesh at the start is nearest to its
  /// centroid
  /// + a along the flow axis (of several the one of the lowest number).
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();
};

/// Measures all capsules.
std::vector<Measures> measure(const System& system, const Case& the_case);

/// First line of measures.csv.
std::string measures_header();
/// A row, 17 significant digits.
std::string measures_row(const Measures& measures);

}  // namespace tanktread::driver
