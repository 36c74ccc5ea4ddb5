// What is measured of each capsule beside its D: contour, speed along it, extents, marker, and which way it
// points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "driver/system/capsules_now.hpp"

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
  /// Extent along load.direction (x unless the case says otherwise), over 2 a (extent_along).
  double axial_diameter = 0;
  double transverse_diameter = 0;  ///< largest extent across it, over 2 a (largest_extent_across)
  /// The axis of the starting mesh (mesh_axis), carried by the nodes (carried_direction), of length 1.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double axis_inclination_deg = 0;  ///< of it in the shear plane to the flow axis, in (-180, 180]
  /// The shortest axis of the ellipsoid of equal moments (shortest_axis), of length 1; of its two senses the
  /// one towards the upper wall. Zero where two are equally short, as of a sphere.
  Eigen::Vector3d short_axis = Eigen::Vector3d::Zero();
  double short_inclination_deg = 0;  ///< of it in the shear plane to the flow axis, in (-90, 90]
};

/// Measures all capsules.
std::vector<Measures> measure(const System& system, const Case& the_case);
/// Measures those given.
std::vector<Measures> measure(const CapsulesNow& capsules, const Case& the_case);

/// First line of measures.csv.
std::string measures_header();
/// A row, 17 significant digits.
std::string measures_row(const Measures& measures);

}  // namespace tanktread::driver
