#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <cstdint>

#include "exchange/content_hash.hpp"
#include "exchange/grid_file.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/grid_writer.hpp"
#include "exchange/vtk_arrays.hpp"
#include "exchange/vtk_calls.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

void check_frame(vtkImageData& image, const path& file) {
  const int* extent = image.GetExtent();
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5]) {
    throw FileError(fmt::format("{}: has no nodes: the grid's extent is {}", file.string(),
                                fmt::join(extent, extent + 6, " ")));
  }
  if (!image.GetDirectionMatrix()->IsIdentity()) {
    throw FileError(
        fmt::format("{}: the grid's axes are turned (Direction is not the identity); resample it along "
                    "x, y and z first",
                    file.string()));
  }
  if (image.GetCellData()->GetNumberOfArrays() > 0) {
    throw FileError(
        fmt::format("{}: has cell data ('{}'), but grids carry point data only; convert it, as with "
                    "ParaView's filter Cell Data to Point Data",
                    file.string(), image.GetCellData()->GetArrayName(0)));
  }
}

/// As a grid by itself.
GridPacket alone(GridPacket packet) {
  packet.origin = first_node(packet);
  packet.begin = {0, 0, 0};
  return packet;
}

/// All but the hash, which stays among the field data. @param exact refuses numbers as ASCII
GridPacket read(const path& file, Convert convert, bool exact) {
  vtkNew<vtkXMLImageDataReader> reader;
  read_with(*reader, file, "ImageData", exact);
  auto* image = reader->GetOutput();
  check_frame(*image, file);
  GridPacket packet;
  image->GetDimensions(packet.nodes.data());
  image->GetSpacing(packet.spacing.data());
  // VTK's origin is that of index 0, which need not be the first node of an extent.
  image->GetOrigin(packet.origin.data());
  for (std::size_t axis = 0; axis < 3; ++axis) packet.begin[axis] = image->GetExtent()[2 * axis];
  packet.point_data = take_arrays(*image->GetPointData(), convert, "point data", file);
  packet.field_data = take_arrays(*image->GetFieldData(), convert, "field data", file);
  return packet;
}

}  // namespace

void write_grid(const path& file, const GridPacket& packet) {
  std::vector<ArrayShape> shapes;
  for (const auto& array : packet.point_data) shapes.push_back({array.name, array.components});
  GridWriter writer(file, packet, shapes);
  std::int64_t n_nodes = 1;
  for (const int n : packet.nodes) n_nodes *= n;
  check_arrays(packet.point_data, n_nodes, "point data", file);
  for (const auto& array : packet.point_data) writer.add(array.values);
  writer.finish();
}

GridPacket read_piece(const path& file, bool convert) {
  auto packet = read(file, convert ? Convert::with_losses : Convert::nothing, !convert);
  check_content(packet, file);
  return packet;
}

GridPacket read_grid(const path& file, bool convert) {
  if (file.extension() != ".pvti") return alone(read_piece(file, convert));
  const auto index = read_grid_index(file);
  return alone(read_grid_block(file, index, index.whole, convert));
}

GridPacket read_exact_grid(const path& file) {
  auto packet = alone(read(file, Convert::exactly, true));
  drop_hash(packet.field_data);
  return packet;
}

}  // namespace tanktread::exchange
