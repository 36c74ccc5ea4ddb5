#include "tests/fuzz/seeds.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "driver/case/schema.hpp"
#include "driver/observe/observables.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/surface_pieces.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/unit/case_samples.hpp"

namespace tanktread::fuzz {
namespace {

exchange::SurfacePacket tetrahedron() {
  exchange::SurfacePacket packet;
  packet.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  packet.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  packet.point_data = {{"velocity", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}};
  packet.cell_data = {{"capsule", 1, {0, 0, 0, 0}}};
  packet.field_data = {{"step", 1, {40}}};
  return packet;
}

exchange::GridPacket small_grid() {
  exchange::GridPacket packet;
  packet.nodes = {2, 2, 1};
  packet.point_data = {{"density", 1, {1, 2, 3, 4}}};
  packet.field_data = {{"step", 1, {40}}};
  return packet;
}

/// With numbers of other types, as programs that are not ours write them.
vtkNew<vtkUnstructuredGrid> other_surface() {
  const auto packet = tetrahedron();
  vtkNew<vtkPoints> points;  // of single precision
  for (int k = 0; k < 4; ++k) points->InsertNextPoint(&packet.points[3 * std::size_t(k)]);
  vtkNew<vtkCellArray> cells;
  for (std::size_t k = 0; k < packet.triangles.size(); k += 3) {
    const vtkIdType corners[] = {packet.triangles[k], packet.triangles[k + 1], packet.triangles[k + 2]};
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(5, cells);
  vtkNew<vtkIntArray> part;
  part->SetName("part");
  part->InsertNextValue(7);
  grid->GetFieldData()->AddArray(part);
  return grid;
}

vtkNew<vtkImageData> other_grid() {
  vtkNew<vtkImageData> image;
  image->SetExtent(1, 2, 0, 1, 0, 0);
  vtkNew<vtkFloatArray> density;
  density->SetName("density");
  for (int k = 0; k < 4; ++k) density->InsertNextValue(static_cast<float>(k));
  image->GetPointData()->AddArray(density);
  return image;
}

/// Every form of VTK's files: numbers as text, in base64, appended; plain and compressed.
template <class Writer, class Data>
std::vector<std::string> all_forms(Data& data) {
  std::vector<std::string> forms;
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    for (const bool compressed : {false, true}) {
      if (mode == vtkXMLWriter::Ascii && compressed) continue;
      vtkNew<Writer> writer;
      writer->SetInputData(&data);
      writer->WriteToOutputStringOn();
      writer->SetDataMode(mode);
      writer->SetHeaderTypeToUInt32();
      if (!compressed) writer->SetCompressorTypeToNone();
      writer->Write();
      forms.push_back(writer->GetOutputString());
    }
  }
  return forms;
}

template <class Write>
std::string written(const Write& write) {
  static const WorkFolder folder;
  write(folder / "seed");
  return bytes_of(folder / "seed");
}

std::vector<std::string> surfaces() {
  const auto other = other_surface();
  auto all = all_forms<vtkXMLUnstructuredGridWriter>(*other);
  all.push_back(written([](const auto& file) { exchange::write_surface(file, tetrahedron()); }));
  return all;
}

std::vector<std::string> grids() {
  const auto other = other_grid();
  auto all = all_forms<vtkXMLImageDataWriter>(*other);
  all.push_back(written([](const auto& file) { exchange::write_grid(file, small_grid()); }));
  return all;
}

/// An index as it is, and without its numbers of the whole, as another program writes one.
std::vector<std::string> with_and_without(const std::string& index) {
  const std::string first = "    <FieldData>", last = "</FieldData>\n";
  const auto begin = index.find(first), end = index.find(last) + last.size();
  return {index, index.substr(0, begin) + index.substr(end)};
}

exchange::SurfaceIndex surface_index() {
  const auto piece = tetrahedron();
  return {{{"velocity", 3}}, {{"capsule", 1}}, piece.field_data, {"0.vtu", "1.vtu"}};
}

/// small_grid() twice, side by side: they share a layer.
exchange::GridIndex grid_index() {
  const auto piece = small_grid();
  return {{{0, 0, 0}, {3, 2, 1}}, piece.origin,
          piece.spacing,          {{"density", 1}},
          piece.field_data,       {{"0.vti", {{0, 0, 0}, {2, 2, 1}}}, {"1.vti", {{1, 0, 0}, {2, 2, 1}}}}};
}

std::vector<std::string> surface_indexes() {
  return with_and_without(
      written([](const auto& file) { exchange::write_surface_index(file, surface_index()); }));
}

std::vector<std::string> grid_indexes() {
  return with_and_without(written([](const auto& file) { exchange::write_grid_index(file, grid_index()); }));
}

std::string small_series() {
  return written([](const auto& file) {
    exchange::write_series(file, {{0, "a.vtu"}, {0.25, "folder/b & c.vtu"}});
  });
}

std::string observables_to_step_50() {
  auto text = driver::observables_header();
  for (int step = 0; step <= 50; step += 10) {
    driver::Observation row;
    row.step = step;
    text += driver::observables_row(row);
  }
  return text;
}

std::vector<std::string> assignments() {
  return {"flow.box=[20, 20, 20]", "capsule.0.radius=5", "flow.box.2=30",
          "flow.start=developed",  "title=\"a\"",        "membrane={capillary_number = 0.1}",
          "coupler.kernel=roma3",  "coupler={}",         "coupler.tangential_correction=false"};
}

std::vector<std::string> words_of_vtk() {
  std::vector<std::string> words = {"<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\">",
                                    "</Piece>",
                                    "<PointData>",
                                    "<CellData>",
                                    "<FieldData>",
                                    "<Points>",
                                    "<Cells>",
                                    "<DataSet timestep=\"0\" file=\"a\"/>",
                                    "RangeMin=\"0\"",
                                    "offset=\"0\"",
                                    "Name=\"types\"",
                                    "Name=\"offsets\"",
                                    "Name=\"connectivity\"",
                                    "Name=\"faces\"",
                                    "Name=\"faceoffsets\"",
                                    "header_type=\"UInt64\"",
                                    "compressor=\"vtkZLibDataCompressor\"",
                                    "byte_order=\"BigEndian\"",
                                    "NumberOfComponents=\"3\"",
                                    "NumberOfTuples=\"1\"",
                                    "encoding=\"raw\"",
                                    "encoding=\"base64\"",
                                    "WholeExtent=\"0 1 0 1 0 0\"",
                                    "Extent=\"0 1 0 1 0 0\"",
                                    "Direction=\"1 0 0 0 1 0 0 0 1\""};
  for (const char* type : {"Float64", "Float32", "Int64", "UInt8", "String", "Bit"})
    words.push_back(std::string("type=\"") + type + "\"");
  for (const char* format : {"ascii", "binary", "appended"})
    words.push_back(std::string("format=\"") + format + "\"");
  return words;
}

std::vector<std::string> words_of_indexes() {
  auto words = words_of_vtk();
  for (const char* word :
       {"<PPoints>", "<PPointData>", "<PCellData>", "<Piece Source=\"0.vtu\"/>", "GhostLevel=\"1\"",
        "<PDataArray type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\"/>",
        "<Piece Extent=\"1 2 0 1 0 0\" Source=\"1.vti\"/>", "Source=\"1.vtu\"", "2147483647", "-2147483648"})
    words.emplace_back(word);
  return words;
}

/// The keys of the case file and what they may hold.
std::vector<std::string> words_of_cases() {
  std::vector<std::string> words = {"[[capsule]]", "capsule.0.", "inf", "nan", "1e308", "-1", "\"\"\""};
  for (const auto& key : driver::schema()) {
    words.push_back(key.path);
    words.push_back(key.path.substr(key.path.rfind('.') + 1) + " = ");
    for (const auto& choice : key.choices) words.push_back("\"" + choice + "\"");
  }
  return words;
}

}  // namespace

std::vector<std::string> seeds(const std::string& target) {
  using namespace tanktread::testing;
  if (target == "case_file") return {least_case, full_case, droplet_case, si_case};
  if (target == "assignment") return assignments();
  if (target == "surface") return surfaces();
  if (target == "grid") return grids();
  if (target == "surface_index") return surface_indexes();
  if (target == "grid_index") return grid_indexes();
  if (target == "series") return {small_series()};
  const auto table = observables_to_step_50();
  if (target == "table") return {table + "\n====\n" + table, "# a\nx,y\n1,2\n\n====\nx,z\n1.0,2\n"};
  return {table};
}

void write_pieces(const std::filesystem::path& folder) {
  auto surface = tetrahedron();
  surface.field_data.push_back({"history_0", 1, {0.5}});
  exchange::write_surface(folder / "0.vtu", surface);
  surface.field_data.back().name = "history_1";
  exchange::write_surface(folder / "1.vtu", surface);
  auto grid = small_grid();
  exchange::write_grid(folder / "0.vti", grid);
  grid.begin[0] = 1;
  exchange::write_grid(folder / "1.vti", grid);
}

std::vector<std::string> words(const std::string& target) {
  if (target == "case_file" || target == "assignment") return words_of_cases();
  if (target == "surface_index" || target == "grid_index") return words_of_indexes();
  if (target == "surface" || target == "grid" || target == "series") return words_of_vtk();
  return {
      ",", "\n", "\r\n", "#", "\n====\n", "nan", "-inf", "1e-300", "step,shear_time", "9223372036854775808"};
}

}  // namespace tanktread::fuzz
