// A surface in pieces: several .vtu, each of whole surfaces, and a .pvtu that names them, as ParaView reads
// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// What a .pvtu says: a surface in pieces, several .vtu, each of whole surfaces (a capsule is never cut, and
/// no node is in two pieces).
struct SurfaceIndex {
  std::vector<ArrayShape> point_data, cell_data;  ///< that every piece has, of doubles
  /// Numbers of the whole (step, shear_time, schema_version), as every piece has them.
  std::vector<Array> field_data;
  /// Paths relative to the index, in the order in which they are put together; at least one.
  std::vector<std::string> pieces;
};

/// Writes a .pvtu (temporary name, then rename). Its pieces should be there: a reader opens them at once.
/// Each is a surface file (write_surface) with these arrays and field data, and field data of its own.
/// @throws FileError, also if there is no piece or one twice, or a name or number does not survive in XML
void write_surface_index(const std::filesystem::path& file, const SurfaceIndex& index);

/// Reads a .pvtu, without its pieces; they must be there.
/// @throws FileError if it is not there, damaged or of another kind, for pieces that overlap (GhostLevel),
/// for no piece or one twice, and naming a piece that is missing
SurfaceIndex read_surface_index(const std::filesystem::path& file);

/// One piece with all that its file has: points, triangles (corners count from its own first node), arrays.
/// @param index of the file @param piece its number, from 0 @param convert as read_surface
/// @throws FileError as read_surface, naming the piece; also if it has other arrays than the index says, or
/// other numbers of the whole. std::out_of_range if the index has no piece of that number
SurfacePacket read_surface_piece(const std::filesystem::path& file, const SurfaceIndex& index,
                                 std::size_t piece, bool convert = false);

}  // namespace tanktread::exchange
