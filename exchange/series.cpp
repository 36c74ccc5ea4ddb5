#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <fstream>
#include <sstream>

#include "exchange/vtk_support.hpp"

namespace tanktread::exchange {
namespace {

/// Text as the value of an XML attribute.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += character;
    }
  }
  return result;
}

}  // namespace

void write_series(const std::filesystem::path& file, const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const auto& entry : entries) {
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", entry.time,
                        escaped(entry.file));
  }
  write_text(file, text + "  </Collection>\n</VTKFile>\n");
}

std::vector<SeriesEntry> read_series(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw FileError(fmt::format("{}: there is no such file", file.string()));
  std::ifstream stream(file);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromStream(stream));
  auto* collection = root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw FileError(fmt::format("{}: not a .pvd collection", file.string()));
  std::vector<SeriesEntry> entries;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    auto* data_set = collection->GetNestedElement(k);
    SeriesEntry entry{0, ""};
    const char* name = data_set->GetAttribute("file");
    if (name == nullptr || data_set->GetScalarAttribute("timestep", entry.time) == 0) {
      throw FileError(fmt::format("{}: entry {} has no file or no timestep", file.string(), k));
    }
    entry.file = name;
    entries.push_back(entry);
  }
  return entries;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  write_then_rename(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw FileError(fmt::format("{}: cannot be written", file.string()));
  });
}

}  // namespace tanktread::exchange
