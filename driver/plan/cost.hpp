// What a run will cost: memory, disk and time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/plan/probe.hpp"
#include "driver/system/shape_source.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Files of one kind.
struct FilesCost {
  std::string name;      ///< "membrane files"
  double n_written = 0;  ///< in the whole run
  double n_kept = 0;     ///< at its end
  double bytes = 0;      ///< of one
  double seconds = 0;    ///< to find and write one; 0: not measured
};

/// Estimates from the sizes of a case and from what a probe measured.
struct Cost {
  double memory_bytes =
      0;  ///< at the peak: lattice twice (while a checkpoint is written), membranes, program
  std::vector<FilesCost> files;
  double mlups = 0;         ///< million node updates a second; 0: not measured
  double step_seconds = 0;  ///< of all steps
  double fluid_node_seconds = 0, membrane_node_seconds = 0;  ///< as in Probe
  std::string breakdown;                                     ///< what ended the probe; "": nothing did

  double disk_bytes() const;       ///< at the end
  double disk_peak_bytes() const;  ///< while the last checkpoint is written beside those that are kept
  double write_seconds() const;    ///< of all files and rows
};

/// Memory of program and libraries.
inline constexpr double program_memory_bytes = 20e6;

/// Memory of the membrane of a capsule with so many nodes: with its triangles, at work and in a file, and
/// their history.
double membrane_memory_bytes(const Case& the_case, std::size_t capsule, double n_nodes);

/// In a state, of a triangle with its half of a node: what a file of membranes has, normals and histories.
inline constexpr double triangle_state_bytes = 370;

/// Memory at the peak of a run, within some 15 % where it is over 20 MB (measured for boxes of 24^3 to 100^3
/// and meshes of level 2 to 7).
double memory_needed_bytes(const Case& the_case, std::span<const MeshSize> meshes);

Cost predict_cost(const Case& the_case, const Parameters& parameters, std::span<const MeshSize> meshes,
                  const Probe& probe);

}  // namespace tanktread::driver
