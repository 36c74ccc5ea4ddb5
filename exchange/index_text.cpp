#include "exchange/index_text.hpp"

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
#include "exchange/same_bits.hpp"
#include "exchange/xml_text.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

constexpr double most = 1e6;  ///< components, or numbers of an array that the index has itself

/// @param absent if the element says none
int count_of(vtkXMLDataElement& element, const char* attribute, int absent, const path& file) {
  const auto numbers = numbers_of(element, attribute, 1, file);
  if (numbers.empty()) return absent;
  if (numbers[0] >= 1 && numbers[0] <= most && numbers[0] == std::floor(numbers[0]))
    return static_cast<int>(numbers[0]);
  refuse_attribute(attribute, text_of(element, attribute, file),
                   fmt::format("a whole number from 1 to {}", most), file);
}

bool has(vtkXMLDataElement& element, const char* attribute, std::string_view text) {
  const char* found = element.GetAttribute(attribute);
  return found != nullptr && std::string_view(found) == text;
}

}  // namespace

std::string numbers_text(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{}{:.17g}", text.empty() ? "" : " ", number);
  return text;
}

std::string field_data_text(const std::vector<Array>& arrays) {
  if (arrays.empty()) return "";
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

std::string shapes_text(const std::string& element, const std::vector<ArrayShape>& shapes) {
  auto text = fmt::format("    <{}>\n", element);
  for (const auto& shape : shapes) {
    text += fmt::format("      <PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
                        escaped(shape.name), shape.components);
  }
  return text + fmt::format("    </{}>\n", element);
}

std::string index_text(const std::string& type, const std::string& attributes, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <{} {}>\n{}  </{}>\n</VTKFile>\n",
      type, type, attributes, content, type);
}

void parse_index(const std::string& text, const std::string& type, const path& file, const UseOfIndex& use) {
  std::istringstream stream(text);
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file);
  auto* root = parser->GetRootElement();
  const char* found = root->GetAttribute("type");
  if (found == nullptr || std::string_view(found) != type) {
    throw FileError(
        fmt::format("{}: {}", file.string(), other_type(file, found != nullptr ? found : "unknown", type)));
  }
  auto* main = root->FindNestedElementWithName(type.c_str());
  if (main == nullptr)
    throw FileError(fmt::format("{}: has no element {}: it is damaged", file.string(), type));
  use(*parser, *main);
}

std::string text_of(vtkXMLDataElement& element, const char* attribute, const path& file) {
  const char* text = element.GetAttribute(attribute);
  if (text != nullptr) return text;
  throw FileError(fmt::format("{}: its element {} lacks the attribute '{}': it is damaged; write it again",
                              file.string(), element.GetName(), attribute));
}

std::vector<ArrayShape> shapes_of(vtkXMLDataElement& element, const path& file) {
  std::vector<ArrayShape> shapes;
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    auto& array = *element.GetNestedElement(k);
    if (has(array, "type", "String")) continue;
    shapes.push_back({text_of(array, "Name", file), count_of(array, "NumberOfComponents", 1, file)});
  }
  return shapes;
}

std::vector<Array> field_data_of(vtkXMLDataParser& parser, vtkXMLDataElement& element, const path& file) {
  std::vector<Array> arrays;
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    auto& nested = *element.GetNestedElement(k);
    if (!has(nested, "format", "ascii") || has(nested, "type", "String")) continue;
    Array array{text_of(nested, "Name", file), count_of(nested, "NumberOfComponents", 1, file), {}};
    const auto n_tuples = count_of(nested, "NumberOfTuples", 1, file);
    if (static_cast<double>(array.components) * n_tuples > most) {
      refuse_attribute("NumberOfTuples", text_of(nested, "NumberOfTuples", file),
                       fmt::format("one of {} numbers at most", most), file);
    }
    array.values.resize(static_cast<std::size_t>(array.components) * static_cast<std::size_t>(n_tuples));
    const auto n_read =
        parser.ReadInlineData(&nested, 1, array.values.data(), 0, array.values.size(), VTK_DOUBLE);
    if (n_read != array.values.size()) {
      throw FileError(
          fmt::format("{}: its array '{}' has {} numbers, {} are needed: it is damaged; write it "
                      "again",
                      file.string(), array.name, n_read, array.values.size()));
    }
    arrays.push_back(std::move(array));
  }
  return arrays;
}

bool same_arrays(const std::vector<Array>& a, const std::vector<Array>& b) {
  return std::ranges::equal(
      a, b, [](const Array& x, const Array& y) { return x.name == y.name && same_bits(x, y); });
}

void require_survival(const path& file, const std::function<bool()>& is_same) {
  bool survives = false;
  try {
    survives = is_same();
  } catch (const FileError&) {  // which says that a file is damaged, and there is none
  }
  if (survives) return;
  throw FileError(
      fmt::format("{}: cannot be written: a name or a number of it does not survive in XML", file.string()));
}

double bytes_of_pieces(const std::vector<std::string>& pieces, const path& index) {
  double n_bytes = 0;
  for (const auto& piece : pieces) {
    const auto name = index.parent_path() / piece;
    if (!std::filesystem::is_regular_file(name))
      throw FileError(fmt::format("{}: no such file, a piece of {}", name.string(), index.string()));
    n_bytes += static_cast<double>(std::filesystem::file_size(name));
  }
  return n_bytes;
}

}  // namespace tanktread::exchange
