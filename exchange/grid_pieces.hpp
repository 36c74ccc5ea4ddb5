// A grid in pieces: several .vti, each of a block of its nodes, and a .pvti that names them, as ParaView
// reads them.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// A block of nodes.
struct GridBlock {
  std::array<int, 3> begin = {0, 0, 0};  ///< its first node
  std::array<int, 3> nodes = {0, 0, 0};  ///< along x, y, z
  bool operator==(const GridBlock&) const = default;
};

/// A piece of a grid.
struct GridPiece {
  std::string file;  ///< path relative to the index
  GridBlock block;
};

/// What a .pvti says. Every cell of the grid (the cube between eight nodes) is in one piece, so that
/// neighbours share one layer of nodes; VTK 9.1 reads nothing at all otherwise. Along an axis of one node
/// that node counts as a cell.
struct GridIndex {
  GridBlock whole;
  std::array<double, 3> origin = {0.5, 0.5, 0.5};  ///< of node (0, 0, 0), as of every piece
  std::array<double, 3> spacing = {1, 1, 1};
  std::vector<ArrayShape> point_data;  ///< that every piece has
  std::vector<Array> field_data;       ///< as every piece has them
  std::vector<GridPiece> pieces;
};

/// Writes a .pvti (temporary name, then rename). Its pieces should be there: a reader opens them at once.
/// Each is a grid file (write_grid) with the `begin` of its block, the same origin, arrays and field data.
/// @throws FileError, also if a cell is in no piece or in two, or a name or number does not survive in XML
void write_grid_index(const std::filesystem::path& file, const GridIndex& index);

/// Reads a .pvti, without its pieces; they must be there.
/// @throws FileError if it is not there, damaged or of another kind, for a cell that is in no piece or in
/// two, and naming a piece that is missing
GridIndex read_grid_index(const std::filesystem::path& file);

/// The numbers of a block of nodes, with its `begin` and the field data of the index. Only pieces with nodes
/// in the block are read, one at a time.
/// @param index of the file @param convert as read_grid
/// @throws FileError as read_grid, naming the piece; also if one is another than the index says: other nodes,
/// frame, arrays or field data. std::invalid_argument if the block is not in the whole
GridPacket read_grid_block(const std::filesystem::path& file, const GridIndex& index, const GridBlock& block,
                           bool convert = false);

/// The numbers of a block, read as they are asked for. Of pieces as we write them (write_grid) nothing is
/// kept in memory; of others what they have of the block.
class GridBlockReader {
 public:
  /// Reads the pieces with nodes in the block once, one at a time, and holds each against its hash and the
  /// index. @throws as read_grid_block
  GridBlockReader(const std::filesystem::path& file, const GridIndex& index, const GridBlock& block,
                  bool convert = false);
  ~GridBlockReader();
  GridBlockReader(const GridBlockReader&) = delete;
  GridBlockReader& operator=(const GridBlockReader&) = delete;

  /// The numbers of an array of the index on the layers z = first, ..., end - 1 of the block, counted from
  /// its own first one.
  /// @param values as many as there are; overwritten @throws FileError if a piece cannot be read or is
  /// another than before
  void read(const std::string& array, int first, int end, std::span<double> values) const;

 private:
  class Piece;
  GridBlock block_;
  std::vector<ArrayShape> point_data_;
  std::vector<Piece> pieces_;
};

}  // namespace tanktread::exchange
