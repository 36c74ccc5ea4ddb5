#include "driver/system/surface_files.hpp"

#include <fmt/format.h>

#include "driver/program/file_ending.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

std::vector<exchange::ArrayShape> shapes_of(const std::vector<exchange::Array>& arrays) {
  std::vector<exchange::ArrayShape> shapes;
  for (const auto& array : arrays) shapes.push_back({array.name, array.components});
  return shapes;
}

}  // namespace

std::vector<CapsuleRange> ranges_of_pieces(std::span<const std::int64_t> n_triangles, std::int64_t most) {
  std::vector<CapsuleRange> ranges = {{0, 0}};
  std::int64_t n = 0;
  for (std::size_t k = 0; k < n_triangles.size(); ++k) {
    if (n > 0 && n_triangles[k] > most - n) {
      ranges.push_back({k, k});
      n = 0;
    }
    n += n_triangles[k];
    ranges.back().end = k + 1;
  }
  return ranges;
}

exchange::SurfacePacket surface_to_write(const CapsulesNow& capsules, const MembraneArrays& arrays,
                                         bool is_state) {
  auto packet = membrane_file(capsules, arrays);
  if (is_state) add_state(packet, capsules, arrays);
  return packet;
}

fs::path file_of_piece(const fs::path& file, std::size_t piece, std::size_t n_pieces) {
  return n_pieces == 1 ? with_ending(file, ".vtu") : file / fmt::format("{}.vtu", piece);
}

void write_index_of_pieces(const fs::path& file, const exchange::SurfacePacket& first, std::size_t n_pieces) {
  exchange::SurfaceIndex index{shapes_of(first.point_data), shapes_of(first.cell_data), {}, {}};
  for (const char* name : {"step", "schema_version", "shear_time"})
    index.field_data.push_back(exchange::find_array(first.field_data, name, file.string()));
  for (std::size_t piece = 0; piece < n_pieces; ++piece)
    index.pieces.push_back((file.filename() / fmt::format("{}.vtu", piece)).string());
  exchange::write_surface_index(with_ending(file, ".pvtu"), index);
}

void write_surfaces(const SurfacesToWrite& what, const CapsulesNow& capsules) {
  std::vector<std::int64_t> n_triangles;
  for (const auto& membrane : capsules.membranes) n_triangles.push_back(membrane.n_triangles());
  const auto arrays = arrays_of(capsules.membranes);
  const auto ranges = ranges_of_pieces(n_triangles, what.most_triangles);
  if (ranges.size() > 1) fs::create_directories(what.file);
  exchange::SurfacePacket first;
  for (std::size_t piece = 0; piece < ranges.size(); ++piece) {
    const auto [begin, end] = ranges[piece];
    auto packet = surface_to_write(capsules.some(begin, end - begin), arrays, what.is_state);
    exchange::write_surface(file_of_piece(what.file, piece, ranges.size()), packet);
    if (piece == 0) first = std::move(packet);
  }
  if (ranges.size() > 1) write_index_of_pieces(what.file, first, ranges.size());
}

std::int64_t most_triangles(const Case& the_case, FileSizes sizes) {
  return sizes == FileSizes::by_case ? the_case.output.whole_file_triangles
                                     : std::numeric_limits<std::int64_t>::max();
}

}  // namespace tanktread::driver
