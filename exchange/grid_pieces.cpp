#include "exchange/grid_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "exchange/grid_file.hpp"
#include "exchange/piece_arrays.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

/// Nodes from `first` to before `end`.
struct Range {
  std::array<int, 3> first, end;
  bool is_empty() const { return first[0] >= end[0] || first[1] >= end[1] || first[2] >= end[2]; }
};

Range range_of(const GridBlock& block) {
  Range range{block.begin, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) range.end[axis] = block.begin[axis] + block.nodes[axis];
  return range;
}

Range common(const Range& a, const Range& b) {
  Range range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.first[axis] = std::max(a.first[axis], b.first[axis]);
    range.end[axis] = std::min(a.end[axis], b.end[axis]);
  }
  return range;
}

/// The nodes that are taken from a piece: all but its last layers, which are the next piece's first ones. So
/// every node is taken once.
Range own_nodes(const GridBlock& piece, const GridBlock& whole) {
  auto range = range_of(piece);
  const auto all = range_of(whole);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (range.end[axis] < all.end[axis]) --range.end[axis];
  }
  return range;
}

std::size_t place(const GridBlock& block, int x, int y, int z) {
  const auto in_x = static_cast<std::size_t>(x - block.begin[0]);
  const auto in_y = static_cast<std::size_t>(y - block.begin[1]);
  const auto in_z = static_cast<std::size_t>(z - block.begin[2]);
  return (in_z * static_cast<std::size_t>(block.nodes[1]) + in_y) * static_cast<std::size_t>(block.nodes[0]) +
         in_x;
}

/// Copies the nodes of a range from one block to another, row by row.
void copy(const Array& from, const GridBlock& from_block, const Range& range, Array& to,
          const GridBlock& to_block) {
  const auto components = static_cast<std::size_t>(to.components);
  const auto n = components * static_cast<std::size_t>(range.end[0] - range.first[0]);
  for (int z = range.first[2]; z < range.end[2]; ++z) {
    for (int y = range.first[1]; y < range.end[1]; ++y) {
      std::copy_n(from.values.data() + components * place(from_block, range.first[0], y, z), n,
                  to.values.data() + components * place(to_block, range.first[0], y, z));
    }
  }
}

/// What the index says of a piece is what the piece says of itself.
void check_piece(const GridPacket& packet, const GridPiece& piece, const GridIndex& index,
                 const PieceName& name) {
  if (packet.begin != piece.block.begin || packet.nodes != piece.block.nodes) {
    refuse_piece(name, fmt::format("has {} x {} x {} nodes from node ({}, {}, {}) of the whole",
                                   packet.nodes[0], packet.nodes[1], packet.nodes[2], packet.begin[0],
                                   packet.begin[1], packet.begin[2]));
  }
  if (packet.origin != index.origin || packet.spacing != index.spacing)
    refuse_piece(name, "has another origin or spacing");
  check_numbers_of_whole(packet.field_data, index.field_data, name);
  check_shapes(packet.point_data, index.point_data, name);
}

}  // namespace

GridPacket read_grid_block(const path& file, const GridIndex& index, const GridBlock& block, bool convert) {
  const auto range = range_of(block);
  const auto in_whole = common(range, range_of(index.whole));
  if (range.is_empty() || in_whole.first != range.first || in_whole.end != range.end)
    throw std::invalid_argument(file.string() + ": a block that is not in the grid is asked for");
  GridPacket result{block.nodes, index.origin, index.spacing, block.begin, {}, index.field_data};
  const auto n_nodes = static_cast<std::size_t>(block.nodes[0]) * static_cast<std::size_t>(block.nodes[1]) *
                       static_cast<std::size_t>(block.nodes[2]);
  for (const auto& [name, components] : index.point_data)
    result.point_data.push_back(
        {name, components, std::vector<double>(n_nodes * static_cast<std::size_t>(components))});
  for (const auto& piece : index.pieces) {
    const auto wanted = common(own_nodes(piece.block, index.whole), range);
    if (wanted.is_empty()) continue;
    const PieceName name{file.parent_path() / piece.file, file};
    const auto packet = read_piece(name.piece, convert);
    check_piece(packet, piece, index, name);
    for (auto& array : result.point_data)
      copy(find_array(packet.point_data, array.name, name.piece.string()), piece.block, wanted, array, block);
  }
  return result;
}

}  // namespace tanktread::exchange
