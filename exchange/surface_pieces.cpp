#include "exchange/surface_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "exchange/append_surface.hpp"
#include "exchange/piece_arrays.hpp"
#include "exchange/surface_file.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

PieceName name_of(const path& file, const SurfaceIndex& index, std::size_t piece) {
  return {file.parent_path() / index.pieces.at(piece), file};
}

/// What the index does not name would be lost without a word.
void refuse_others(const std::vector<Array>& arrays, const std::vector<ArrayShape>& shapes,
                   const PieceName& name) {
  for (const auto& array : arrays) {
    if (std::ranges::find(shapes, array.name, &ArrayShape::name) == shapes.end())
      refuse_piece(name, fmt::format("has an array '{}'", array.name));
  }
}

void check_arrays(const std::vector<Array>& arrays, const std::vector<ArrayShape>& shapes,
                  const PieceName& name) {
  check_shapes(arrays, shapes, name);
  refuse_others(arrays, shapes, name);
}

SurfacePacket read_piece(const PieceName& name, const SurfaceIndex& index, Reading reading) {
  auto packet = read_surface_file(name.piece, reading);
  check_numbers_of_whole(packet.field_data, index.field_data, name);
  check_arrays(packet.point_data, index.point_data, name);
  check_arrays(packet.cell_data, index.cell_data, name);
  return packet;
}

/// Pieces put one after the other.
class Whole {
 public:
  explicit Whole(const SurfaceIndex& index) : result_{{}, {}, {}, {}, index.field_data} {
    for (const auto& [name, components] : index.point_data)
      result_.point_data.push_back({name, components, {}});
    for (const auto& [name, components] : index.cell_data)
      result_.cell_data.push_back({name, components, {}});
    for (const auto& array : index.field_data) owners_.emplace(array.name, "");
  }

  /// @throws FileError for a number of its own that another piece has too
  void add(SurfacePacket piece, const PieceName& name) {
    append_surface(result_, piece);
    for (auto& array : piece.field_data) add_own(std::move(array), name);
  }

  SurfacePacket take() { return std::move(result_); }

 private:
  void add_own(Array array, const PieceName& name) {
    const auto [owner, is_new] = owners_.emplace(array.name, name.piece);
    if (is_new) {
      result_.field_data.push_back(std::move(array));
    } else if (!owner->second.empty()) {  // else it is one of the whole
      throw FileError(fmt::format(
          "{}: has the field data '{}', as has {}, and {}, whose pieces they are, has none of that name: "
          "only one piece can have them; write or copy all again",
          name.piece.string(), array.name, owner->second.string(), name.index.string()));
    }
  }

  SurfacePacket result_;
  std::map<std::string, path> owners_;  ///< the piece that each array of field data is of; "" for the whole
};

SurfacePacket read_all(const path& file, Reading reading) {
  if (file.extension() != ".pvtu") return read_surface_file(file, reading);
  const auto index = read_surface_index(file);
  Whole whole(index);
  for (std::size_t piece = 0; piece < index.pieces.size(); ++piece) {
    const auto name = name_of(file, index, piece);
    whole.add(read_piece(name, index, reading), name);
  }
  return whole.take();
}

}  // namespace

SurfacePacket read_surface_piece(const path& file, const SurfaceIndex& index, std::size_t piece,
                                 bool convert) {
  return read_piece(name_of(file, index, piece), index, convert ? Reading::converted : Reading::as_written);
}

SurfacePacket read_surface(const path& file, bool convert) {
  return read_all(file, convert ? Reading::converted : Reading::as_written);
}

SurfacePacket read_exact_surface(const path& file) {
  return read_all(file, Reading::exact);
}

}  // namespace tanktread::exchange
