// A case tried for a moment, to see how fast it is here.
#pragma once

#include <string>

#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/system/system.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

struct Probe {
  double mlups = 0;                  ///< million node updates a second of the first steps; 0: they broke down
  double fluid_node_seconds = 0;     ///< that the fluid's own step takes a node
  double membrane_node_seconds = 0;  ///< that the rest of a step (membranes, coupler) takes a membrane node
  std::string breakdown;             ///< with these words; "" if they did not
  double observables_seconds = 0;    ///< to find the rows of one time of observables.csv; 0: not measured
  double measures_seconds = 0;       ///< likewise of measures.csv
  double energy_seconds = 0;         ///< likewise of energy.csv
  double membrane_file_seconds = 0;  ///< to write one, and its entry in the .pvd; 0: not measured
  double grid_seconds_per_byte = 0;  ///< to write fluid files and states; 0: not measured
};

/// Runs the first steps of a case, for a second or a tenth of the run, finds a row of each table that it has,
/// and writes a membrane file and a fluid file (at most 32 MB of it) to the system's directory for temporary
/// files, from which they are removed.
/// @param sharing of several ranks with the others: as make_system()
Probe try_case(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes,
               Sharing sharing = Sharing::all_ranks);

}  // namespace tanktread::driver
