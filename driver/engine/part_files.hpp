// The membranes of a case whose capsules are on many ranks: made, and in files. Internal to driver/engine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "driver/engine/system_part.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/system/surface_files.hpp"
#include "exchange/packet.hpp"
#include "ranks/packing.hpp"

namespace tanktread::driver {

/// How the writing of membranes ended on a rank.
struct SurfacesWritten {
  std::string error;         ///< "": all is well
  std::size_t n_pieces = 0;  ///< of all ranks
  /// Of several pieces the first, on the first rank, which has written it.
  std::optional<exchange::SurfacePacket> first;
};

/// Writes the pieces of all capsules: piece k is written by rank k modulo their number, to which owners send
/// their capsules, so that no rank has more than one piece at a time. Together.
SurfacesWritten write_surfaces(const SystemPart& part, const SurfacesToWrite& what);

void pack(ranks::Packing& packing, const SurfacesToWrite& what);
SurfacesToWrite take_surfaces_to_write(ranks::Unpacking& unpacking);

/// Capsules of a case at its start.
struct CapsulesMade {
  std::optional<StepError> error;  ///< of a mesh file that is no longer as it was
  std::vector<PartCapsule> capsules;
};

/// Makes every so manieth capsule, so that each is made by one rank.
CapsulesMade make_capsules(const ranks::World& world, const Case& the_case);

/// Some capsules of a state in pieces.
struct CapsulesRead {
  std::string error;     ///< of this rank; "": all is well
  bool all_well = true;  ///< on all ranks
  std::vector<PartCapsule> capsules;
};

/// Reads every so manieth piece, so that each is read by one rank. Together.
/// @param n_capsules of the case, each of which must be there once
CapsulesRead read_capsules(const ranks::World& world, const std::filesystem::path& index_file,
                           std::size_t n_capsules);

/// The capsules that something was saved of.
std::vector<PartCapsule> part_capsules(SavedCapsules saved);

}  // namespace tanktread::driver
