// The membranes of a case as a file: what a person looks at, and what the membrane component goes on from.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "driver/packets/packets.hpp"
#include "driver/system/capsule_membrane.hpp"
#include "driver/system/capsules_now.hpp"
#include "exchange/packet.hpp"

namespace tanktread::driver {

/// Positions and triangles of all membranes.
Surfaces surfaces_of(std::span<const CapsuleMembrane> membranes);

/// Which arrays a file of membranes has beside those of any: all files of a case have the same, whatever
/// capsules are in them.
struct MembraneArrays {
  std::vector<std::string> terms;  ///< energies beside the law (term_names())
  bool has_loads = false;          ///< of any capsule
  bool starts_elsewhere = false;   ///< any capsule, than its stress-free shape is
};

/// Those that a file of these alone has.
MembraneArrays arrays_of(std::span<const CapsuleMembrane> membranes);

/// Membranes as one surface. Point data velocity, elastic_force (of the law), of the energies beside it
/// that any membrane has bending_force, global_area_force, local_area_force, volume_force, total_force, and
/// where a capsule has a load load_force; cell data principal_stretches, stress, viscous_stress, area_ratio,
/// capsule; field data step, shear_time, schema_version.
/// @param capsules whose numbers follow one another
exchange::SurfacePacket membrane_file(const CapsulesNow& capsules, const MembraneArrays& arrays);
/// The same of all capsules of a case.
/// @param velocity that moved the nodes to their positions
/// @param force the total force at the positions
exchange::SurfacePacket membrane_file(const std::vector<CapsuleMembrane>& membranes,
                                      const NodeVectors& velocity, const NodeVectors& force,
                                      std::int64_t step, double shear_time);

/// Adds what the membranes need to go on: point data reference_position, where that is not where they started
/// start_position, field data history_0, history_1 ... (Membrane::history()), and of programs
/// program_0_point_NAME, program_0_cell_NAME (OutsideMembrane::state()), with the numbers of the capsules.
void add_state(exchange::SurfacePacket& file, const CapsulesNow& capsules, const MembraneArrays& arrays);
/// The same of all capsules of a case.
void add_state(exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes);

/// Takes the states over. @param name of the file, for messages
/// @throws exchange::FileError if a history is missing or is not one of these membranes
void restore_membranes(std::vector<CapsuleMembrane>& membranes, const exchange::SurfacePacket& file,
                       const std::string& name);

/// A state goes on from its own shapes only. A file without `reference_position` passes.
/// @throws exchange::FileError if they are not those of the membranes, but for rounding
void check_references(const exchange::SurfacePacket& file, const std::vector<CapsuleMembrane>& membranes,
                      const std::string& name);

/// @throws exchange::FileError unless the surfaces have the nodes and triangles of the membranes
void check_surfaces(const Surfaces& surfaces, const std::vector<CapsuleMembrane>& membranes,
                    const std::string& name);

}  // namespace tanktread::driver
