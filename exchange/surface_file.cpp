#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "exchange/vtk_support.hpp"

namespace tanktread::exchange {
namespace {

vtkNew<vtkCellArray> make_cells(const SurfacePacket& packet, std::int64_t n_points,
                                const std::filesystem::path& file) {
  if (packet.triangles.size() % 3 != 0) throw FileError(file.string() + ": triangles need three nodes each");
  vtkNew<vtkCellArray> cells;
  for (std::size_t k = 0; k < packet.triangles.size(); k += 3) {
    cells->InsertNextCell(3);
    for (int corner = 0; corner < 3; ++corner) {
      const std::int64_t node = packet.triangles[k + corner];
      if (node < 0 || node >= n_points) {
        throw FileError(
            fmt::format("{}: triangle {} names node {}; there are {}", file.string(), k / 3, node, n_points));
      }
      cells->InsertCellPoint(node);
    }
  }
  return cells;
}

void copy_points(vtkUnstructuredGrid* grid, bool convert, const std::filesystem::path& file,
                 SurfacePacket& packet) {
  auto* points = grid->GetPoints();
  if (points == nullptr) return;
  if (points->GetDataType() != VTK_DOUBLE && !convert) {
    throw FileError(
        fmt::format("{}: points are {}, must be double (Float64); convert the file, or write doubles",
                    file.string(), points->GetData()->GetDataTypeAsString()));
  }
  packet.points.resize(3 * points->GetNumberOfPoints());
  for (vtkIdType node = 0; node < points->GetNumberOfPoints(); ++node)
    points->GetPoint(node, &packet.points[3 * node]);
}

void copy_triangles(vtkUnstructuredGrid* grid, const std::filesystem::path& file, SurfacePacket& packet) {
  packet.triangles.reserve(3 * grid->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (grid->GetCellType(cell) != VTK_TRIANGLE) {
      throw FileError(fmt::format(
          "{}: cell {} is of VTK type {}, must be a triangle ({}); keep the triangles of the surface only",
          file.string(), cell, grid->GetCellType(cell), static_cast<int>(VTK_TRIANGLE)));
    }
    vtkIdType n_nodes = 0;
    const vtkIdType* nodes = nullptr;
    grid->GetCellPoints(cell, n_nodes, nodes);
    for (int corner = 0; corner < 3; ++corner) {
      if (nodes[corner] < 0 || nodes[corner] >= grid->GetNumberOfPoints()) {
        throw FileError(fmt::format("{}: triangle {} names node {}; there are {}", file.string(), cell,
                                    nodes[corner], grid->GetNumberOfPoints()));
      }
      packet.triangles.push_back(nodes[corner]);
    }
  }
}

}  // namespace

void write_surface(const std::filesystem::path& file, const SurfacePacket& packet) {
  const auto n_points = static_cast<std::int64_t>(packet.points.size() / 3);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  constexpr int keep_ours = 1;  // VTK must not free it; the writer only reads
  coordinates->SetArray(const_cast<double*>(packet.points.data()), 3 * n_points, keep_ours);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(coordinates);
  grid->SetPoints(points);
  const auto cells = make_cells(packet, n_points, file);
  grid->SetCells(VTK_TRIANGLE, cells);
  lend_arrays(packet.point_data, n_points, grid->GetPointData(), file);
  lend_arrays(packet.cell_data, static_cast<std::int64_t>(packet.triangles.size() / 3), grid->GetCellData(),
              file);
  lend_arrays(packet.field_data, 0, grid->GetFieldData(), file);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_whole(writer, file);
}

SurfacePacket read_surface(const std::filesystem::path& file, bool convert) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read_whole(reader, file);
  auto* grid = reader->GetOutput();
  SurfacePacket packet;
  copy_points(grid, convert, file, packet);
  copy_triangles(grid, file, packet);
  packet.point_data = copy_arrays(grid->GetPointData(), convert, file);
  packet.cell_data = copy_arrays(grid->GetCellData(), convert, file);
  packet.field_data = copy_arrays(grid->GetFieldData(), convert, file);
  return packet;
}

}  // namespace tanktread::exchange
