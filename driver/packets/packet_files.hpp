// The packets of a step as VTK files: .vtu for what lives on capsules, .vti for what lives on the grid.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "driver/packets/packets.hpp"
#include "exchange/packet.hpp"

namespace tanktread::driver {

/// Version of the arrays and their meaning; a file of a later one is refused.
inline constexpr double schema_version = 1;

/// Number of nodes of the grid along x, y, z.
using Box = std::array<int, 3>;

/// All capsules as one surface: their nodes one after the other, cell data `capsule` with the number of the
/// capsule of each triangle, field data `step` and `schema_version`.
/// @param first_number of the first of these capsules
exchange::SurfacePacket surface_file(const Surfaces& surfaces, std::int64_t step,
                                     std::size_t first_number = 0);

/// Point data of what the membrane stage writes where a membrane has an implicit viscosity: the forces so
/// far, to which `tanktread implicit` adds the implicit viscous ones.
inline constexpr const char* explicit_force_array = "explicit_force";

/// Adds vectors on the nodes as point data.
void add_vectors(exchange::SurfacePacket& file, const std::string& name,
                 std::span<const Eigen::Matrix3Xd> vectors);

/// The capsules of a surface: those of its cell data `capsule`, or one without that.
/// @param name of the file, for messages
/// @throws exchange::FileError if nodes or triangles of a capsule do not lie together, in the order of the
/// capsules; for a later schema version
Surfaces surfaces_of(const exchange::SurfacePacket& file, const std::string& name);

/// Vectors on the nodes of those surfaces. @throws exchange::FileError if the array is missing or has not
/// three components
NodeVectors vectors_of(const exchange::SurfacePacket& file, const std::string& array,
                       const Surfaces& surfaces, const std::string& name);

/// @throws exchange::FileError unless there are as many capsules as in `like`, of as many nodes each
void check_sizes(const NodeVectors& vectors, const NodeVectors& like, const std::string& name);

/// Point data of a grid that says where the vectors of a packet are: 1 there, else 0.
inline constexpr const char* touched_array = "touched";

/// Point data of the free velocity: what a force on a node adds to its velocity.
inline constexpr const char* mobility_array = "mobility";

/// Vectors on some nodes as an array on the whole grid, zero elsewhere; point data `touched` says 1 where the
/// vectors are. Their mobility, if they have one, is an array beside it.
exchange::GridPacket grid_file(const GridVectors& vectors, const std::string& array, const Box& box,
                               std::int64_t step);

/// @throws exchange::FileError if the grid is not the box: a whole one, its first node at 1/2, 1/2, 1/2
void check_grid(const exchange::GridPacket& file, const Box& box, const std::string& name);

/// The vectors on the nodes where `touched` is not zero, on all nodes without that array, with their mobility
/// if there is one.
/// @throws exchange::FileError if the grid is not the box (a whole one: its first node at 1/2, 1/2, 1/2), the
/// array is missing or has not three components; for a later schema version
GridVectors grid_vectors_of(const exchange::GridPacket& file, const std::string& array, const Box& box,
                            const std::string& name);

/// Marks of all nodes as an array "inside", and point data `touched`, which says 1 where they are news.
/// @param all one a node of the box
exchange::GridPacket marks_file(const GridMarks& news, std::span<const std::int32_t> all, const Box& box,
                                std::int64_t step);

/// The marks on the nodes where `touched` is not zero, on all nodes without that array.
/// @param n_capsules marks go up to that
/// @throws exchange::FileError as grid_vectors_of(), and for a mark that is no capsule's
GridMarks grid_marks_of(const exchange::GridPacket& file, std::size_t n_capsules, const Box& box,
                        const std::string& name);

/// Field data step and schema_version, which every packet begins with.
std::vector<exchange::Array> packet_header(std::int64_t step);

/// The step of a file; 0 without the array `step`. @throws exchange::FileError if it is not a whole number
std::int64_t step_of(const std::vector<exchange::Array>& field_data, const std::string& name);

/// @throws exchange::FileError for a later schema version than this program's; a file without one passes:
/// programs from outside cannot write it
void check_schema_version(const std::vector<exchange::Array>& field_data, const std::string& name);

}  // namespace tanktread::driver
