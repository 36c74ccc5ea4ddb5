#include "exchange/surface_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>

#include "exchange/content_hash.hpp"
#include "exchange/meshio_padding.hpp"
#include "exchange/vtk_arrays.hpp"
#include "exchange/vtk_calls.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

void check_node(std::int64_t node, std::int64_t n_nodes, std::size_t corner, const path& file) {
  if (node < 0 || node >= n_nodes) {
    throw FileError(fmt::format("{}: triangle {} has node {}, outside 0 to {}", file.string(), corner / 3,
                                node, n_nodes - 1));
  }
}

void check_triangles(const SurfacePacket& packet, const path& file) {
  if (packet.points.size() % 3 != 0 || packet.triangles.size() % 3 != 0) {
    throw FileError(
        fmt::format("{}: cannot be written: {} coordinates and {} corners; both must be multiples of 3",
                    file.string(), packet.points.size(), packet.triangles.size()));
  }
  const auto n_nodes = static_cast<std::int64_t>(packet.points.size() / 3);
  for (std::size_t corner = 0; corner < packet.triangles.size(); ++corner) {
    check_node(packet.triangles[corner], n_nodes, corner, file);
  }
}

void set_points(const SurfacePacket& packet, vtkUnstructuredGrid& grid) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetArray(const_cast<double*>(packet.points.data()),
                        static_cast<vtkIdType>(packet.points.size()), 1);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);  // which makes them double; vtkPoints of its own is float
  grid.SetPoints(points);
}

void set_triangles(const SurfacePacket& packet, vtkUnstructuredGrid& grid) {
  const auto n_triangles = static_cast<vtkIdType>(packet.triangles.size() / 3);
  vtkNew<vtkTypeInt64Array> connectivity, offsets;
  connectivity->SetNumberOfValues(3 *
                                  n_triangles);  // copied: VTK's 64-bit integer may be another type than ours
  std::copy(packet.triangles.begin(), packet.triangles.end(), connectivity->GetPointer(0));
  offsets->SetNumberOfValues(n_triangles + 1);
  for (vtkIdType k = 0; k <= n_triangles; ++k) offsets->SetValue(k, 3 * k);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  grid.SetCells(VTK_TRIANGLE, cells);
}

/// The lengths in bytes of all arrays, in the order in which VTK writes them.
std::vector<std::int64_t> lengths_in_file(const SurfacePacket& packet, const std::vector<Array>& hash) {
  std::vector<std::int64_t> lengths;
  for (const auto* arrays : {&hash, &packet.field_data, &packet.point_data, &packet.cell_data}) {
    for (const auto& array : *arrays) lengths.push_back(8 * static_cast<std::int64_t>(array.values.size()));
  }
  const auto n_triangles = static_cast<std::int64_t>(packet.triangles.size() / 3);
  lengths.push_back(8 * static_cast<std::int64_t>(packet.points.size()));
  lengths.insert(lengths.end(), {24 * n_triangles, 8 * n_triangles, n_triangles});  // corners, offsets, types
  return lengths;
}

void add_padding(const SurfacePacket& packet, const std::vector<Array>& hash, vtkUnstructuredGrid& grid) {
  const auto n_doubles = padding_for_meshio(lengths_in_file(packet, hash));
  if (!n_doubles) return;
  vtkNew<vtkDoubleArray> padding;
  padding->SetName(padding_name);
  padding->SetNumberOfValues(*n_doubles);
  padding->Fill(0);
  grid.GetFieldData()->AddArray(padding);
}

/// "Line", "Quad" ...: VTK's class without its prefix.
std::string name_of_cell(int type) {
  const char* found = vtkCellTypes::GetClassNameFromTypeId(type);
  const std::string name = found != nullptr ? found : "";
  return name.starts_with("vtk") ? name.substr(3) : fmt::format("cell of type {}", type);
}

std::vector<std::int64_t> triangles_of(vtkUnstructuredGrid& grid, const path& file) {
  const auto n_cells = grid.GetNumberOfCells();
  std::vector<std::int64_t> triangles;
  triangles.reserve(3 * static_cast<std::size_t>(n_cells));
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < n_cells; ++cell) {
    grid.GetCells()->GetCellAtId(cell, nodes);
    if (grid.GetCellType(cell) != VTK_TRIANGLE || nodes->GetNumberOfIds() != 3) {
      throw FileError(
          fmt::format("{}: cell {} is a {} of {} nodes; only triangles can be read: triangulate the "
                      "surface first, and leave out volume and edge cells",
                      file.string(), cell, name_of_cell(grid.GetCellType(cell)), nodes->GetNumberOfIds()));
    }
    for (const vtkIdType node : *nodes) {
      check_node(node, grid.GetNumberOfPoints(), triangles.size(), file);
      triangles.push_back(node);
    }
  }
  return triangles;
}

/// All but the hash, which stays among the field data. @param exact refuses numbers as ASCII
SurfacePacket read(const path& file, Convert convert, bool exact) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read_with(*reader, file, "UnstructuredGrid", exact);
  auto* grid = reader->GetOutput();
  SurfacePacket packet;
  packet.triangles = triangles_of(*grid, file);
  if (grid->GetPoints() != nullptr) {
    packet.points = values_of(*grid->GetPoints()->GetData(), convert, points_text, file);
  }
  packet.point_data = take_arrays(*grid->GetPointData(), convert, "point data", file);
  packet.cell_data = take_arrays(*grid->GetCellData(), convert, "cell data", file);
  grid->GetFieldData()->RemoveArray(padding_name);
  packet.field_data = take_arrays(*grid->GetFieldData(), convert, "field data", file);
  return packet;
}

}  // namespace

void write_surface(const path& file, const SurfacePacket& packet) {
  check_triangles(packet, file);
  check_names(packet.field_data, file);
  const std::vector<Array> hash = {to_array(content_hash(packet))};
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(packet, *grid);
  set_triangles(packet, *grid);
  add_arrays(packet.point_data, grid->GetNumberOfPoints(), *grid->GetPointData(), "point data", file);
  add_arrays(packet.cell_data, grid->GetNumberOfCells(), *grid->GetCellData(), "cell data", file);
  add_padding(packet, hash, *grid);
  add_arrays(hash, any_size, *grid->GetFieldData(), "field data", file);
  add_arrays(packet.field_data, any_size, *grid->GetFieldData(), "field data", file);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_with(*writer, *grid, file);
}

SurfacePacket read_surface_file(const path& file, Reading reading) {
  if (reading == Reading::exact) {
    auto packet = read(file, Convert::exactly, true);
    drop_hash(packet.field_data);
    return packet;
  }
  const bool convert = reading == Reading::converted;
  auto packet = read(file, convert ? Convert::with_losses : Convert::nothing, !convert);
  check_content(packet, file);
  return packet;
}

}  // namespace tanktread::exchange
