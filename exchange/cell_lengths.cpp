#include "exchange/cell_lengths.hpp"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include <cstring>
#include <optional>
#include <string_view>

#include "exchange/promised_sizes.hpp"
#include "exchange/vtk_calls.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

/// nullptr if there is none of the name.
vtkXMLDataElement* array_named(vtkXMLDataElement& cells, const char* name) {
  for (int k = 0; k < cells.GetNumberOfNestedElements(); ++k) {
    auto* array = cells.GetNestedElement(k);
    const char* found = array->GetAttribute("Name");
    if (found != nullptr && std::strcmp(found, name) == 0) return array;
  }
  return nullptr;
}

/// nullptr if the file is not compressed, or in a way that its reader does not know.
vtkSmartPointer<vtkDataCompressor> compressor_of(vtkXMLDataElement& root) {
  const char* found = root.GetAttribute("compressor");
  const std::string_view name = found != nullptr ? found : "";
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
  return nullptr;
}

/// The number at place `index` of an array; nothing if it cannot be read, of which VTK's reader will speak.
std::optional<double> number_at(vtkXMLDataParser& parser, vtkXMLDataElement& array, std::uint64_t index) {
  int type = 0;
  if (array.GetWordTypeAttribute("type", type) != 1) return std::nullopt;
  const auto number = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  number->SetNumberOfTuples(1);
  auto* buffer = number->GetVoidPointer(0);
  long long offset = 0;
  const char* format = array.GetAttribute("format");
  const bool is_ascii = format != nullptr && std::strcmp(format, "ascii") == 0;
  const auto n_read = array.GetScalarAttribute("offset", offset) == 1
                          ? parser.ReadAppendedData(offset, buffer, index, 1, type)
                          : parser.ReadInlineData(&array, is_ascii ? 1 : 0, buffer, index, 1, type);
  if (n_read != 1) return std::nullopt;
  return number->GetComponent(0, 0);
}

}  // namespace

void check_cell_lengths(vtkXMLDataParser& parser, std::istream& stream, std::uint64_t n_bytes,
                        const std::filesystem::path& file) {
  auto& root = *parser.GetRootElement();
  auto* grid = root.FindNestedElementWithName("UnstructuredGrid");
  if (grid == nullptr) return;
  VtkMessages messages;  // what is wrong with an array its reader will say, too
  messages.listen_to(&parser);
  const auto compressor = compressor_of(root);
  if (root.GetAttribute("compressor") != nullptr && compressor == nullptr) return;
  parser.SetCompressor(compressor);
  stream.clear();
  for (int k = 0; k < grid->GetNumberOfNestedElements(); ++k) {
    auto& piece = *grid->GetNestedElement(k);
    auto* cells = piece.FindNestedElementWithName("Cells");
    auto* offsets = cells != nullptr ? array_named(*cells, "offsets") : nullptr;
    int n_cells = 0;
    if (offsets == nullptr || piece.GetScalarAttribute("NumberOfCells", n_cells) != 1 || n_cells < 1)
      continue;
    const auto last = number_at(parser, *offsets, static_cast<std::uint64_t>(n_cells) - 1);
    if (!last || fits_in_file(root, *last, sizeof(std::int64_t), n_bytes)) continue;
    throw FileError(fmt::format(
        "{}: its cells are said to have {:.10g} node numbers (the last offset), which a file of {} bytes "
        "cannot hold: it is damaged; write or copy it again",
        file.string(), *last, n_bytes));
  }
}

}  // namespace tanktread::exchange
