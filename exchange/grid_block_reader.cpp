#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "exchange/grid_file.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/piece_arrays.hpp"
#include "exchange/raw_grid_file.hpp"

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

GridBlock block_of(const Range& range) {
  GridBlock block{range.first, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) block.nodes[axis] = range.end[axis] - range.first[axis];
  return block;
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

/// Calls with each row of a range: the node at its beginning, and how many nodes it has.
template <class Body>
void for_rows(const Range& range, const Body& body) {
  const auto n = static_cast<std::size_t>(range.end[0] - range.first[0]);
  for (int z = range.first[2]; z < range.end[2]; ++z)
    for (int y = range.first[1]; y < range.end[1]; ++y) body(y, z, n);
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

/// Of the arrays what lies in a range. @param block whose nodes the arrays have
std::vector<Array> cut_out(const std::vector<Array>& arrays, const GridBlock& block, const Range& range) {
  std::vector<Array> result;
  std::size_t n_nodes = 0;
  for_rows(range, [&](int, int, std::size_t n) { n_nodes += n; });
  for (const auto& array : arrays) {
    const auto components = static_cast<std::size_t>(array.components);
    Array part{array.name, array.components, {}};
    part.values.reserve(components * n_nodes);
    for_rows(range, [&](int y, int z, std::size_t n) {
      const auto first =
          array.values.begin() + static_cast<std::ptrdiff_t>(components * place(block, range.first[0], y, z));
      part.values.insert(part.values.end(), first, first + static_cast<std::ptrdiff_t>(components * n));
    });
    result.push_back(std::move(part));
  }
  return result;
}

}  // namespace

/// A piece with nodes in the block, after it was checked.
class GridBlockReader::Piece {
 public:
  /// @param wanted nodes of it
  Piece(const PieceName& name, const GridPiece& piece, const GridIndex& index, const Range& wanted,
        bool convert)
      : wanted_(wanted), name_(name.piece.string()), raw_(RawGridFile::open(name.piece, convert)) {
    if (raw_) {
      raw_->check_content();
      check_piece(raw_->grid(), piece, index, name);
      block_ = piece.block;
      return;
    }
    const auto packet = read_piece(name.piece, convert);
    check_piece(packet, piece, index, name);
    block_ = block_of(wanted);
    arrays_ = cut_out(packet.point_data, piece.block, wanted);
  }

  /// What it has of a range of layers of a block, put there. @param to_block of the numbers `to`
  void read(const ArrayShape& shape, const GridBlock& to_block, std::span<double> to) const {
    const auto range = common(wanted_, range_of(to_block));
    if (range.is_empty()) return;
    std::optional<RawGridFile::Opened> opened;
    const Array* array = nullptr;
    if (raw_) {
      opened.emplace(*raw_, shape.name);
    } else {
      array = &find_array(arrays_, shape.name, name_);
    }
    const auto components = static_cast<std::size_t>(shape.components);
    for_rows(range, [&](int y, int z, std::size_t n) {
      const auto row = to.subspan(components * place(to_block, range.first[0], y, z), components * n);
      const auto first = components * place(block_, range.first[0], y, z);
      if (opened) {
        opened->read(first, row);
      } else {
        std::copy_n(&array->values[first], row.size(), row.begin());
      }
    });
  }

 private:
  Range wanted_;
  std::string name_;
  std::optional<RawGridFile> raw_;
  std::vector<Array> arrays_;  ///< of a file in another form
  GridBlock block_;            ///< of what the file or the arrays have
};

GridBlockReader::GridBlockReader(const path& file, const GridIndex& index, const GridBlock& block,
                                 bool convert)
    : block_(block), point_data_(index.point_data) {
  const auto range = range_of(block);
  const auto in_whole = common(range, range_of(index.whole));
  if (range.is_empty() || in_whole.first != range.first || in_whole.end != range.end)
    throw std::invalid_argument(file.string() + ": a block that is not in the grid is asked for");
  for (const auto& piece : index.pieces) {
    const auto wanted = common(own_nodes(piece.block, index.whole), range);
    if (wanted.is_empty()) continue;
    pieces_.emplace_back(PieceName{file.parent_path() / piece.file, file}, piece, index, wanted, convert);
  }
}

GridBlockReader::~GridBlockReader() = default;

void GridBlockReader::read(const std::string& name, int first, int end, std::span<double> values) const {
  const auto shape = std::ranges::find(point_data_, name, &ArrayShape::name);
  if (shape == point_data_.end())
    throw std::invalid_argument(
        fmt::format("a grid in pieces is asked for an array '{}', which it lacks", name));
  GridBlock layers = block_;
  layers.begin[2] += first;
  layers.nodes[2] = end - first;
  for (const auto& piece : pieces_) piece.read(*shape, layers, values);
}

}  // namespace tanktread::exchange
