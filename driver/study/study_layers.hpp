// Two liquids between walls: the flow of the lattice Boltzmann solver against the exact one, wherever in a
// cell of the grid they meet, and the velocity that the coupler gives a sheet between them.
#pragma once

#include <string>
#include <vector>

#include "driver/study/layers_flow.hpp"

namespace tanktread::driver {

/// Errors over the largest exact speed between the walls. Mean: over the places of the sheet, signed where a
/// velocity is meant (ours less exact). Largest: the largest size over the places.
struct LayersErrors {
  double nodes_mean, nodes_largest;  ///< root mean square over the nodes, at each place
  double
      nodes_bias;  ///< root mean square over the nodes of the mean over the places: what does not average out
  double sheet_mean, sheet_largest;    ///< velocity that the coupler gives the sheet
  double dipole_mean, dipole_largest;  ///< likewise with the shear dipole of coupler::dipole_length()
};

/// @throws std::invalid_argument naming the parameter that is out of range
/// @throws RunError as steady_velocities()
LayersErrors layers_errors(const LayersStudy& study);

/// The table of `tanktread study layers`, as CSV: a row a study.
/// @throws as layers_errors()
std::string layers_table(const std::vector<LayersStudy>& studies);

}  // namespace tanktread::driver
