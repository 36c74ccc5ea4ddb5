// The index of a grid in pieces: VTK's .pvti. Its own writer of it wants the data of all pieces.
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkType.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "exchange/file_head.hpp"
#include "exchange/file_kind.hpp"
#include "exchange/grid_head.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/promised_sizes.hpp"
#include "exchange/same_bits.hpp"
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

std::string numbers_text(const auto& numbers) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{}{:.17g}", text.empty() ? "" : " ", number);
  return text;
}

std::string field_data_text(const std::vector<Array>& arrays) {
  std::string text = "    <FieldData>\n";
  for (const auto& array : arrays) {
    text += fmt::format(
        "      <DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" "
        "format=\"ascii\">{}</DataArray>\n",
        escaped(array.name), array.components,
        array.values.size() / static_cast<std::size_t>(std::max(array.components, 1)),
        numbers_text(array.values));
  }
  return text + "    </FieldData>\n";
}

std::string to_xml(const GridIndex& index) {
  auto text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <{} WholeExtent=\"{}\" GhostLevel=\"0\" Origin=\"{}\" Spacing=\"{}\">\n",
      type, type, extent_text(index.whole), numbers_text(index.origin), numbers_text(index.spacing));
  if (!index.field_data.empty()) text += field_data_text(index.field_data);
  text += "    <PPointData>\n";
  for (const auto& array : index.point_data) {
    text += fmt::format("      <PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
                        escaped(array.name), array.components);
  }
  text += "    </PPointData>\n";
  for (const auto& piece : index.pieces) {
    text += fmt::format("    <Piece Extent=\"{}\" Source=\"{}\"/>\n", extent_text(piece.block),
                        escaped(piece.file));
  }
  return text + fmt::format("  </{}>\n</VTKFile>\n", type);
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
  double n_bytes = 0, n_numbers = 0;
  for (const auto& piece : index.pieces) {
    const auto name = file.parent_path() / piece.file;
    if (!std::filesystem::is_regular_file(name))
      throw FileError(fmt::format("{}: no such file, a piece of {}", name.string(), file.string()));
    n_bytes += static_cast<double>(std::filesystem::file_size(name));
  }
  for (const auto& array : index.point_data) n_numbers += array.components;
  for (const int n : index.whole.nodes) n_numbers *= n;
  if (n_numbers * sizeof(double) <= growth_of_compressed * n_bytes) return;
  throw FileError(
      fmt::format("{}: promises {:.10g} numbers, which pieces of {:.10g} bytes together cannot "
                  "hold: it is damaged; write or copy it again",
                  file.string(), n_numbers, n_bytes));
}

std::string text_of(vtkXMLDataElement& element, const char* attribute, const path& file) {
  const char* text = element.GetAttribute(attribute);
  if (text != nullptr) return text;
  throw FileError(fmt::format("{}: its element {} lacks the attribute '{}': it is damaged; write it again",
                              file.string(), element.GetName(), attribute));
}

/// @param absent if the element says none
int count_of(vtkXMLDataElement& element, const char* attribute, int absent, const path& file) {
  constexpr double most = 1e6;  // of components, or of numbers that the index has itself
  const auto numbers = numbers_of(element, attribute, 1, file);
  if (numbers.empty()) return absent;
  if (numbers[0] >= 1 && numbers[0] <= most && numbers[0] == std::floor(numbers[0]))
    return static_cast<int>(numbers[0]);
  refuse_attribute(attribute, text_of(element, attribute, file),
                   fmt::format("a whole number from 1 to {}", most), file);
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

/// Numbers of the whole; those in another form than write_grid_index's are left to VTK.
void read_field_data(vtkXMLDataParser& parser, vtkXMLDataElement& element, GridIndex& index,
                     const path& file) {
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    auto& nested = *element.GetNestedElement(k);
    const char* format = nested.GetAttribute("format");
    if (format == nullptr || std::string_view(format) != "ascii") continue;
    Array array{text_of(nested, "Name", file), count_of(nested, "NumberOfComponents", 1, file), {}};
    array.values.resize(static_cast<std::size_t>(array.components) *
                        static_cast<std::size_t>(count_of(nested, "NumberOfTuples", 1, file)));
    const auto n_read =
        parser.ReadInlineData(&nested, 1, array.values.data(), 0, array.values.size(), VTK_DOUBLE);
    if (n_read != array.values.size()) {
      throw FileError(
          fmt::format("{}: its array '{}' has {} numbers, {} are needed: it is damaged; write it "
                      "again",
                      file.string(), array.name, n_read, array.values.size()));
    }
    index.field_data.push_back(std::move(array));
  }
}

void read_element(vtkXMLDataParser& parser, vtkXMLDataElement& element, GridIndex& index, const path& file) {
  const std::string_view name = element.GetName();
  if (name == "FieldData") read_field_data(parser, element, index, file);
  if (name == "PPointData") {
    for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
      auto& array = *element.GetNestedElement(k);
      index.point_data.push_back(
          {text_of(array, "Name", file), count_of(array, "NumberOfComponents", 1, file)});
    }
  }
  if (name == "Piece")
    index.pieces.push_back({text_of(element, "Source", file), block_of(element, "Extent", file)});
}

GridIndex parse(const std::string& text, const path& file) {
  std::istringstream stream(text);
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file);
  auto* root = parser->GetRootElement();
  const char* found = root->GetAttribute("type");
  if (found == nullptr || std::string_view(found) != type) {
    throw FileError(
        fmt::format("{}: {}", file.string(), other_type(file, found != nullptr ? found : "unknown", type)));
  }
  auto* grid = root->FindNestedElementWithName(type);
  if (grid == nullptr)
    throw FileError(fmt::format("{}: has no element {}: it is damaged", file.string(), type));
  GridIndex index;
  index.whole = block_of(*grid, "WholeExtent", file);
  index.origin = vector_of(*grid, "Origin", 0, file);
  index.spacing = vector_of(*grid, "Spacing", 1, file);
  for (int k = 0; k < grid->GetNumberOfNestedElements(); ++k)
    read_element(*parser, *grid->GetNestedElement(k), index, file);
  return index;
}

bool same_arrays(const std::vector<Array>& a, const std::vector<Array>& b) {
  return std::ranges::equal(
      a, b, [](const Array& x, const Array& y) { return x.name == y.name && same_bits(x, y); });
}

bool same_pieces(const std::vector<GridPiece>& a, const std::vector<GridPiece>& b) {
  return std::ranges::equal(
      a, b, [](const GridPiece& x, const GridPiece& y) { return x.file == y.file && x.block == y.block; });
}

/// Some texts and numbers cannot be put in XML: found by reading what would be written.
void check_survives(const GridIndex& index, const std::string& text, const path& file) {
  const auto back = parse(text, file);
  if (back.origin == index.origin && back.spacing == index.spacing && back.whole == index.whole &&
      back.point_data == index.point_data && same_arrays(back.field_data, index.field_data) &&
      same_pieces(back.pieces, index.pieces))
    return;
  throw FileError(
      fmt::format("{}: cannot be written: a name or a number of it does not survive in XML", file.string()));
}

}  // namespace

void write_grid_index(const path& file, const GridIndex& index) {
  check_cover(index, file, "cannot be written");
  const auto text = to_xml(index);
  check_survives(index, text, file);
  write_text(file, text);
}

GridIndex read_grid_index(const path& file) {
  auto index = parse(read_growing_text(file), file);
  check_cover(index, file, "is damaged");
  check_pieces(index, file);
  return index;
}

}  // namespace tanktread::exchange
