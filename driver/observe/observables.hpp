// What is measured of each capsule, and the table it goes into.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "driver/system/capsules_now.hpp"

namespace tanktread::driver {

/// One row of observables.csv: one capsule at one time.
struct Observation {
  std::int64_t step = 0;
  double shear_time = 0;
  double deformation = 0;      ///< D = (L - W)/(L + W) of the equivalent ellipsoid in the shear plane
  double inclination_deg = 0;  ///< of its long axis to the flow axis
  double length = 0, width = 0, breadth = 0;  ///< its semi-axes, in undeformed radii
  double volume_ratio = 0, area_ratio = 0;    ///< to the mesh at the start
  double elastic_energy = 0;                  ///< lattice units
  double max_speed = 0;                       ///< of the fluid, grid steps a step
  int capsule = 0;
  double x = 0, y = 0, z = 0;  ///< centroid of the enclosed volume, grid steps (not wrapped)
  /// Of the last step, for the implicit viscous forces of all capsules; none: there are no such forces.
  std::optional<int> viscous_iterations = std::nullopt;
};

/// Measures all capsules. The shear plane is that of flow and wall axis.
std::vector<Observation> observe(const System& system, const Case& the_case);
/// Measures those given. @param max_speed, viscous_iterations of all, for each row
std::vector<Observation> observe(const CapsulesNow& capsules, const Case& the_case, double max_speed,
                                 std::optional<int> viscous_iterations);

/// First line of observables.csv. @param has_iterations of a case with an implicit viscosity: a last column
/// more
std::string observables_header(bool has_iterations = false);
/// A row, 17 significant digits, so that a double survives.
std::string observables_row(const Observation& observation);

}  // namespace tanktread::driver
