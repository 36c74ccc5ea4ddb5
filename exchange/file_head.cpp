#include "exchange/file_head.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "exchange/cell_lengths.hpp"
#include "exchange/compressed_blocks.hpp"
#include "exchange/file_kind.hpp"
#include "exchange/grid_head.hpp"
#include "exchange/promised_sizes.hpp"
#include "exchange/vtk_calls.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"

namespace tanktread::exchange {
namespace {

bool has(vtkXMLDataElement& element, const char* attribute, const char* value) {
  const char* found = element.GetAttribute(attribute);
  return found != nullptr && std::strcmp(found, value) == 0;
}

/// The name of each array by its offset, in the order of the offsets.
void collect_offsets(vtkXMLDataElement& element, std::map<std::int64_t, std::string>& names) {
  long long offset = 0;
  if (has(element, "format", "appended") && element.GetScalarAttribute("offset", offset) == 1) {
    const char* name = element.GetAttribute("Name");
    names[offset] = name != nullptr ? name : "";
  }
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k)
    collect_offsets(*element.GetNestedElement(k), names);
}

/// Where the array that begins at `position` ends by its own word; 0 if the file ends before.
std::uint64_t end_of_array(std::ifstream& stream, std::uint64_t position) {
  std::uint64_t length = 0;
  stream.seekg(static_cast<std::streamoff>(position));
  stream.read(reinterpret_cast<char*>(&length), sizeof length);
  return stream ? position + sizeof length + length : 0;
}

bool has_text_at(std::ifstream& stream, std::uint64_t position, std::string_view expected) {
  std::string text(expected.size(), '\0');
  stream.seekg(static_cast<std::streamoff>(position));
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return stream && text == expected;
}

/// By the file's own head; see check_head.
void check_appended_layout(vtkXMLDataParser& parser, std::ifstream& stream,
                           const std::filesystem::path& file) {
  auto& root = *parser.GetRootElement();
  const auto first = static_cast<std::uint64_t>(parser.GetAppendedDataPosition());
  // VTK's own way to begin and end the numbers: with it, not even bytes lost before the end go unseen.
  constexpr std::string_view begin = ">\n   _", end_of_all = "\n  </AppendedData>";
  if (!has_raw_numbers(root) || !has_text_at(stream, first - begin.size(), begin)) return;
  std::map<std::int64_t, std::string> names;
  collect_offsets(root, names);
  for (auto array = names.begin(); array != names.end(); ++array) {
    const auto end = end_of_array(stream, first + static_cast<std::uint64_t>(array->first));
    const auto next = std::next(array);
    const bool fits = next == names.end() ? end != 0 && has_text_at(stream, end, end_of_all)
                                          : end == first + static_cast<std::uint64_t>(next->first);
    if (!fits) {
      throw FileError(
          fmt::format("{}: the numbers of array '{}' are not where the file's head says: the file is "
                      "damaged; write or copy it again",
                      file.string(), array->second));
    }
  }
}

void check_type(vtkXMLDataElement& root, const std::string& type, const std::filesystem::path& file) {
  const char* found = root.GetAttribute("type");
  if (std::string_view(root.GetName()) != "VTKFile" || found == nullptr) {
    throw FileError(fmt::format("{}: is not a VTK XML file (expected one of type {})", file.string(), type));
  }
  if (found != type) {
    throw FileError(fmt::format("{}: {}", file.string(), other_type(file, found, type)));
  }
}

/// VTK takes whatever stands in field data for an array.
void check_only_arrays(vtkXMLDataElement& element, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 3> holders = {"FieldData", "PointData", "CellData"};
  const bool holds_arrays = std::find(holders.begin(), holders.end(), element.GetName()) != holders.end();
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    auto& nested = *element.GetNestedElement(k);
    const std::string_view name = nested.GetName();
    if (holds_arrays && name != "DataArray" && name != "Array") {
      throw FileError(fmt::format(
          "{}: {} holds an element {}, which is no array: the file is damaged; write or copy it again",
          file.string(), element.GetName(), name));
    }
    check_only_arrays(nested, file);
  }
}

void check_array_types(vtkXMLDataElement& element, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 12> known = {"Float64", "Float32", "Int64",  "UInt64",
                                                      "Int32",   "UInt32",  "Int16",  "UInt16",
                                                      "Int8",    "UInt8",   "String", "Bit"};
  const std::string_view name = element.GetName();
  if (name == "DataArray" || name == "Array") {
    const char* type = element.GetAttribute("type");
    if (type == nullptr || std::find(known.begin(), known.end(), type) == known.end()) {
      const char* array = element.GetAttribute("Name");
      throw FileError(fmt::format("{}: array '{}' is of the unknown type '{}'; known are {}", file.string(),
                                  array != nullptr ? array : "", type != nullptr ? type : "",
                                  fmt::join(known, ", ")));
    }
  }
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k)
    check_array_types(*element.GetNestedElement(k), file);
}

void refuse_text_numbers(vtkXMLDataElement& element, const std::filesystem::path& file) {
  if (std::string_view(element.GetName()) == "DataArray" && has(element, "format", "ascii")) {
    const char* array = element.GetAttribute("Name");
    throw FileError(
        fmt::format("{}: array '{}' is written as ASCII, which need not keep every bit; write it as binary "
                    "or appended data",
                    file.string(), array != nullptr ? array : ""));
  }
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k)
    refuse_text_numbers(*element.GetNestedElement(k), file);
}

/// VTK takes the counts within their arrays on trust.
void refuse_polyhedra(vtkXMLDataElement& element, const std::filesystem::path& file) {
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    auto& nested = *element.GetNestedElement(k);
    if (std::string_view(element.GetName()) == "Cells" &&
        (has(nested, "Name", "faces") || has(nested, "Name", "faceoffsets"))) {
      throw FileError(fmt::format(
          "{}: holds polyhedra (its cells have an array '{}'); only triangles can be read: extract "
          "the surface and triangulate it first",
          file.string(), nested.GetAttribute("Name")));
    }
    refuse_polyhedra(nested, file);
  }
}

std::uint64_t size_of(std::ifstream& stream) {
  stream.clear();
  stream.seekg(0, std::ios::end);
  return static_cast<std::uint64_t>(std::max<std::streamoff>(stream.tellg(), 0));
}

int n_field_arrays(vtkXMLDataElement& root, const std::string& type) {
  auto* data_set = root.FindNestedElementWithName(type.c_str());
  auto* field_data = data_set != nullptr ? data_set->FindNestedElementWithName("FieldData") : nullptr;
  return field_data != nullptr ? field_data->GetNumberOfNestedElements() : 0;
}

}  // namespace

void parse_head(vtkXMLDataParser& parser, std::istream& stream, const std::filesystem::path& file) {
  VtkMessages messages;
  messages.listen_to(&parser);
  parser.SetStream(&stream);
  if (parser.Parse() != 1 || !messages.text().empty()) {
    throw FileError(fmt::format("{}: cannot be read: {}", file.string(), messages.text()));
  }
}

bool has_raw_numbers(vtkXMLDataElement& root) {
  auto* data = root.FindNestedElementWithName("AppendedData");
  return data != nullptr && has(*data, "encoding", "raw") && root.GetAttribute("compressor") == nullptr &&
         has(root, "header_type", "UInt64") && has(root, "byte_order", "LittleEndian") &&
         std::endian::native == std::endian::little;
}

int check_head(const WholeFile& file, const std::string& type, bool exact) {
  std::ifstream stream(file.content(), std::ios::binary);
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file.name());
  check_type(*parser->GetRootElement(), type, file.name());
  check_array_types(*parser->GetRootElement(), file.name());
  check_only_arrays(*parser->GetRootElement(), file.name());
  if (exact) refuse_text_numbers(*parser->GetRootElement(), file.name());
  refuse_polyhedra(*parser->GetRootElement(), file.name());
  if (auto* grid = parser->GetRootElement()->FindNestedElementWithName("ImageData"))
    check_grid_head(*grid, file.name());
  const auto n_bytes = size_of(stream);
  check_promised_sizes(*parser->GetRootElement(), n_bytes, file.name());
  check_compressed_blocks(*parser, stream, n_bytes, file.name());
  check_appended_layout(*parser, stream, file.name());
  check_cell_lengths(*parser, stream, n_bytes, file.name());
  return n_field_arrays(*parser->GetRootElement(), type);
}

}  // namespace tanktread::exchange
