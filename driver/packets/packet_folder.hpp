// The packets of steps as files in a directory.
#pragma once

#include <cstdint>
#include <filesystem>

#include "driver/packets/packet_files.hpp"

namespace tanktread::driver {

/// The file of a packet of the step that makes `step`: DIR/node_force/node_force_0000000013.vtu.
std::filesystem::path packet_path(const std::filesystem::path& directory, Packet packet, std::int64_t step);

/// Reads a packet that lives on the grid. @throws exchange::FileError, also if it is of another step
GridVectors read_grid_packet(const std::filesystem::path& file, Packet packet, const Box& box,
                             std::int64_t step);

/// Reads the marks of nodes inside capsules. @throws as above
GridMarks read_marks_packet(const std::filesystem::path& file, std::size_t n_capsules, const Box& box,
                            std::int64_t step);

/// Reads a packet that lives on capsules. @param like capsules with as many nodes
/// @throws exchange::FileError, also if it is of another step
NodeVectors read_node_packet(const std::filesystem::path& file, Packet packet, const NodeVectors& like,
                             std::int64_t step);

}  // namespace tanktread::driver
