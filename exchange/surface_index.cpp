// The index of a surface in pieces: VTK's .pvtu. Its own writer of it wants the data of all pieces.
#include <fmt/format.h>
#include <vtkXMLDataElement.h>

#include <set>
#include <string_view>

#include "exchange/grid_head.hpp"
#include "exchange/index_text.hpp"
#include "exchange/surface_pieces.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"
#include "exchange/xml_text.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

constexpr const char* type = "PUnstructuredGrid";

std::string to_xml(const SurfaceIndex& index) {
  // VTK takes the type of the points from here, which else is float.
  auto content = field_data_text(index.field_data) + shapes_text("PPoints", {{"Points", 3}}) +
                 shapes_text("PPointData", index.point_data) + shapes_text("PCellData", index.cell_data);
  for (const auto& piece : index.pieces)
    content += fmt::format("    <Piece Source=\"{}\"/>\n", escaped(piece));
  return index_text(type, "GhostLevel=\"0\"", content);
}

/// Cells that two pieces have would be there twice.
void check_overlap(vtkXMLDataElement& main, const path& file) {
  const auto level = numbers_of(main, "GhostLevel", 1, file);
  if (level.empty() || level[0] == 0) return;
  refuse_attribute("GhostLevel", text_of(main, "GhostLevel", file), "0, of pieces that share no triangles",
                   file);
}

SurfaceIndex parse(const std::string& text, const path& file) {
  SurfaceIndex index;
  parse_index(text, type, file, [&](vtkXMLDataParser& parser, vtkXMLDataElement& main) {
    check_overlap(main, file);
    for (int k = 0; k < main.GetNumberOfNestedElements(); ++k) {
      auto& element = *main.GetNestedElement(k);
      const std::string_view name = element.GetName();
      if (name == "FieldData") index.field_data = field_data_of(parser, element, file);
      if (name == "PPointData") index.point_data = shapes_of(element, file);
      if (name == "PCellData") index.cell_data = shapes_of(element, file);
      if (name == "Piece") index.pieces.push_back(text_of(element, "Source", file));
    }
  });
  return index;
}

/// @param what "cannot be written" | "is damaged"
void check_pieces(const SurfaceIndex& index, const path& file, const char* what) {
  if (index.pieces.empty())
    throw FileError(
        fmt::format("{}: {}: it names no piece; a surface has at least one", file.string(), what));
  std::set<std::string> names;
  for (const auto& piece : index.pieces) {
    if (names.insert(piece).second) continue;
    throw FileError(fmt::format("{}: {}: it names the piece '{}' twice; every triangle must be in one piece",
                                file.string(), what, piece));
  }
}

bool survives(const SurfaceIndex& index, const std::string& text, const path& file) {
  const auto back = parse(text, file);
  return back.point_data == index.point_data && back.cell_data == index.cell_data &&
         same_arrays(back.field_data, index.field_data) && back.pieces == index.pieces;
}

}  // namespace

void write_surface_index(const path& file, const SurfaceIndex& index) {
  check_pieces(index, file, "cannot be written");
  const auto text = to_xml(index);
  require_survival(file, [&] { return survives(index, text, file); });
  write_text(file, text);
}

SurfaceIndex read_surface_index(const path& file) {
  auto index = parse(read_growing_text(file, type), file);
  check_pieces(index, file, "is damaged");
  bytes_of_pieces(index.pieces, file);
  return index;
}

}  // namespace tanktread::exchange
