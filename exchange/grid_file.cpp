#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include "exchange/vtk_support.hpp"

namespace tanktread::exchange {

void write_grid(const std::filesystem::path& file, const GridPacket& packet) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(packet.nodes[0], packet.nodes[1], packet.nodes[2]);
  image->SetOrigin(packet.origin.data());
  image->SetSpacing(packet.spacing.data());
  const std::int64_t n_nodes = std::int64_t{packet.nodes[0]} * packet.nodes[1] * packet.nodes[2];
  lend_arrays(packet.point_data, n_nodes, image->GetPointData(), file);
  lend_arrays(packet.field_data, 0, image->GetFieldData(), file);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  write_whole(writer, file);
}

GridPacket read_grid(const std::filesystem::path& file, bool convert) {
  vtkNew<vtkXMLImageDataReader> reader;
  read_whole(reader, file);
  auto* image = reader->GetOutput();
  GridPacket packet;
  image->GetDimensions(packet.nodes.data());
  image->GetOrigin(packet.origin.data());
  image->GetSpacing(packet.spacing.data());
  packet.point_data = copy_arrays(image->GetPointData(), convert, file);
  packet.field_data = copy_arrays(image->GetFieldData(), convert, file);
  return packet;
}

}  // namespace tanktread::exchange
