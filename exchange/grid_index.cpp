// The index of a grid in pieces: VTK's .pvti. Its own writer of it wants the data of all pieces.
#include <fmt/format.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <string_view>

#include "exchange/grid_head.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/index_text.hpp"
#include "exchange/promised_sizes.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"
#include "exchange/xml_text.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

constexpr const char* type = "PImageData";

std::string extent_text(const GridBlock& block) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = block.begin[axis];
    text += fmt::format("{}{} {}", axis == 0 ? "" : " ", first, first + block.nodes[axis] - 1);
  }
  return text;
}

std::string to_xml(const GridIndex& index) {
  auto content = field_data_text(index.field_data) + shapes_text("PPointData", index.point_data);
  for (const auto& piece : index.pieces) {
    content += fmt::format("    <Piece Extent=\"{}\" Source=\"{}\"/>\n", extent_text(piece.block),
                           escaped(piece.file));
  }
  return index_text(
      type,
      fmt::format("WholeExtent=\"{}\" GhostLevel=\"0\" Origin=\"{}\" Spacing=\"{}\"",
                  extent_text(index.whole), numbers_text(index.origin), numbers_text(index.spacing)),
      content);
}

Extent as_extent(const GridBlock& block) {
  Extent extent{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[2 * axis] = block.begin[axis];
    extent[2 * axis + 1] = std::int64_t{block.begin[axis]} + block.nodes[axis] - 1;
  }
  return extent;
}

/// Whether two blocks of a whole have a cell in common.
bool overlap(const Extent& a, const Extent& b, const Extent& whole) {
  for (std::size_t k = 0; k < whole.size(); k += 2) {
    const auto common = std::min(a[k + 1], b[k + 1]) - std::max(a[k], b[k]);
    if (whole[k] == whole[k + 1] ? common < 0 : common < 1) return false;
  }
  return true;
}

/// Every cell in one piece. @param what "cannot be written" | "is damaged"
void check_cover(const GridIndex& index, const path& file, const char* what) {
  const auto whole = as_extent(index.whole);
  const auto fail = [&](const std::string& why) {
    throw FileError(
        fmt::format("{}: {}: {}; every cell of the grid must be in one piece, so that neighbours "
                    "share one layer of nodes",
                    file.string(), what, why));
  };
  double filled = 0;
  for (std::size_t k = 0; k < index.pieces.size(); ++k) {
    const auto& piece = index.pieces[k];
    const auto extent = as_extent(piece.block);
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = extent[2 * axis], last = extent[2 * axis + 1];
      // A block of one node has a cell only where the whole has.
      const bool has_cells = last > first || (last == first && whole[2 * axis] == whole[2 * axis + 1]);
      fits = fits && has_cells && first >= whole[2 * axis] && last <= whole[2 * axis + 1];
    }
    if (!fits) {
      fail(fmt::format("the piece '{}' (Extent \"{}\") is no part of the grid (WholeExtent \"{}\")",
                       piece.file, extent_text(piece.block), extent_text(index.whole)));
    }
    filled += cells_of(extent);
    for (std::size_t other = 0; other < k; ++other) {
      if (!overlap(extent, as_extent(index.pieces[other].block), whole)) continue;
      fail(fmt::format("the pieces '{}' (Extent \"{}\") and '{}' (Extent \"{}\") have cells in common",
                       index.pieces[other].file, extent_text(index.pieces[other].block), piece.file,
                       extent_text(piece.block)));
    }
  }
  if (filled == cells_of(whole)) return;
  fail(fmt::format("the grid has {:.10g} cells (WholeExtent), its pieces have {:.10g} (Extent)",
                   cells_of(whole), filled));
}

/// They are there, and together can hold what the index promises, before room is made for it.
void check_pieces(const GridIndex& index, const path& file) {
  std::vector<std::string> names;
  for (const auto& piece : index.pieces) names.push_back(piece.file);
  const auto n_bytes = bytes_of_pieces(names, file);
  double n_numbers = 0;
  for (const auto& array : index.point_data) n_numbers += array.components;
  for (const int n : index.whole.nodes) n_numbers *= n;
  if (n_numbers * sizeof(double) <= growth_of_compressed * n_bytes) return;
  throw FileError(
      fmt::format("{}: promises {:.10g} numbers, which pieces of {:.10g} bytes together cannot "
                  "hold: it is damaged; write or copy it again",
                  file.string(), n_numbers, n_bytes));
}

GridBlock block_of(vtkXMLDataElement& element, const char* attribute, const path& file) {
  const auto extent = extent_of(element, attribute, file);
  GridBlock block;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = extent[2 * axis], last = extent[2 * axis + 1];
    if (last < first)
      refuse_attribute(attribute, text_of(element, attribute, file), "a block of nodes", file);
    block.begin[axis] = static_cast<int>(first);
    block.nodes[axis] = static_cast<int>(last - first + 1);
  }
  return block;
}

std::array<double, 3> vector_of(vtkXMLDataElement& element, const char* attribute, double absent,
                                const path& file) {
  const auto numbers = numbers_of(element, attribute, 3, file);
  if (numbers.empty()) return {absent, absent, absent};
  return {numbers[0], numbers[1], numbers[2]};
}

void read_element(vtkXMLDataParser& parser, vtkXMLDataElement& element, GridIndex& index, const path& file) {
  const std::string_view name = element.GetName();
  if (name == "FieldData") index.field_data = field_data_of(parser, element, file);
  if (name == "PPointData") index.point_data = shapes_of(element, file);
  if (name == "Piece")
    index.pieces.push_back({text_of(element, "Source", file), block_of(element, "Extent", file)});
}

GridIndex parse(const std::string& text, const path& file) {
  GridIndex index;
  parse_index(text, type, file, [&](vtkXMLDataParser& parser, vtkXMLDataElement& grid) {
    index.whole = block_of(grid, "WholeExtent", file);
    index.origin = vector_of(grid, "Origin", 0, file);
    index.spacing = vector_of(grid, "Spacing", 1, file);
    for (int k = 0; k < grid.GetNumberOfNestedElements(); ++k)
      read_element(parser, *grid.GetNestedElement(k), index, file);
  });
  return index;
}

bool same_pieces(const std::vector<GridPiece>& a, const std::vector<GridPiece>& b) {
  return std::ranges::equal(
      a, b, [](const GridPiece& x, const GridPiece& y) { return x.file == y.file && x.block == y.block; });
}

bool survives(const GridIndex& index, const std::string& text, const path& file) {
  const auto back = parse(text, file);
  return back.origin == index.origin && back.spacing == index.spacing && back.whole == index.whole &&
         back.point_data == index.point_data && same_arrays(back.field_data, index.field_data) &&
         same_pieces(back.pieces, index.pieces);
}

}  // namespace

void write_grid_index(const path& file, const GridIndex& index) {
  check_cover(index, file, "cannot be written");
  const auto text = to_xml(index);
  require_survival(file, [&] { return survives(index, text, file); });
  write_text(file, text);
}

GridIndex read_grid_index(const path& file) {
  auto index = parse(read_growing_text(file, type), file);
  check_cover(index, file, "is damaged");
  check_pieces(index, file);
  return index;
}

}  // namespace tanktread::exchange
