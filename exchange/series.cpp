// Series in time: ParaView's .pvd, a list of files and their times. VTK has no writer of it outside ParaView.
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "exchange/file_head.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

/// A text as the value of an XML attribute. Line breaks and tabs are spelled out: XML makes them spaces
/// otherwise.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
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
      case '\n':
        result += "&#10;";
        break;
      case '\r':
        result += "&#13;";
        break;
      case '\t':
        result += "&#9;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string to_xml(const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& entry : entries) {
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" group=\"\" part=\"0\" file=\"{}\"/>\n", entry.time,
                        escaped(entry.file));
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

SeriesEntry to_entry(vtkXMLDataElement& element, int number, const path& file) {
  const char* time = element.GetAttribute("timestep");
  const char* name = element.GetAttribute("file");
  if (time == nullptr || name == nullptr) {
    throw FileError(fmt::format("{}: entry {} lacks its attribute '{}'", file.string(), number,
                                time == nullptr ? "timestep" : "file"));
  }
  SeriesEntry entry{0, name};
  const char* end = time + std::strlen(time);
  const auto [stop, error] = std::from_chars(time, end, entry.time);
  if (error != std::errc() || stop != end || !std::isfinite(entry.time)) {
    throw FileError(fmt::format("{}: entry {} has timestep \"{}\", which is not a finite number",
                                file.string(), number, time));
  }
  return entry;
}

std::vector<SeriesEntry> parse(std::istream& stream, const path& file) {
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file);
  auto* root = parser->GetRootElement();
  const char* type = root->GetAttribute("type");
  auto* collection = root->FindNestedElementWithName("Collection");
  if (type == nullptr || std::strcmp(type, "Collection") != 0 || collection == nullptr) {
    throw FileError(fmt::format("{}: is not a .pvd series: it is of type {}, expected Collection",
                                file.string(), type != nullptr ? type : "unknown"));
  }
  std::vector<SeriesEntry> entries;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    entries.push_back(to_entry(*collection->GetNestedElement(k), k, file));
  }
  return entries;
}

/// Some texts cannot be put in XML at all (control characters, broken UTF-8): found by reading what would be
/// written.
void check_survives(const std::vector<SeriesEntry>& entries, const std::string& text, const path& file) {
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!std::isfinite(entries[k].time)) {
      throw FileError(fmt::format("{}: cannot be written: entry {} ('{}') has time {}, which is not finite",
                                  file.string(), k, entries[k].file, entries[k].time));
    }
  }
  std::istringstream stream(text);
  const auto back = parse(stream, file);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k >= back.size() || back[k].file != entries[k].file || back[k].time != entries[k].time) {
      throw FileError(fmt::format("{}: cannot be written: entry {} ('{}') does not survive in XML",
                                  file.string(), k, entries[k].file));
    }
  }
}

}  // namespace

void write_series(const path& file, const std::vector<SeriesEntry>& entries) {
  const auto text = to_xml(entries);
  check_survives(entries, text, file);
  write_text(file, text);
}

std::vector<SeriesEntry> read_series(const path& file) {
  const WholeFile whole(file);
  std::ifstream stream(whole.content(), std::ios::binary);
  return parse(stream, file);
}

void append_to_series(const path& file, const SeriesEntry& entry) {
  auto entries = read_series(file);
  entries.push_back(entry);
  write_series(file, entries);
}

}  // namespace tanktread::exchange
