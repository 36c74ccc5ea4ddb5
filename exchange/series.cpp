// Series in time: ParaView's .pvd, a list of files and their times. VTK has no writer of it outside ParaView.
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "exchange/file_head.hpp"
#include "exchange/file_kind.hpp"
#include "exchange/file_tail.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"
#include "exchange/xml_text.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

constexpr std::string_view opening =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
constexpr std::string_view before_time = "    <DataSet timestep=\"";
constexpr std::string_view closing = "  </Collection>\n</VTKFile>\n";

/// One time has one text, so that two entries of one time are seen: -0 is written as 0.
std::string to_line(const SeriesEntry& entry) {
  return fmt::format("{}{:.17g}\" group=\"\" part=\"0\" file=\"{}\"/>\n", before_time, entry.time + 0.0,
                     escaped(entry.file));
}

std::string to_xml(const std::vector<SeriesEntry>& entries) {
  std::string text(opening);
  for (const auto& entry : entries) text += to_line(entry);
  return text.append(closing);
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

std::vector<SeriesEntry> parse(const std::string& text, const path& file) {
  std::istringstream stream(text);
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file);
  auto* root = parser->GetRootElement();
  const char* type = root->GetAttribute("type");
  auto* collection = root->FindNestedElementWithName("Collection");
  if (type == nullptr || std::strcmp(type, "Collection") != 0) {
    throw FileError(fmt::format("{}: is not a .pvd series: it {}", file.string(),
                                other_type(file, type != nullptr ? type : "unknown", "Collection")));
  }
  if (collection == nullptr)
    throw FileError(fmt::format("{}: is not a .pvd series: it has no element Collection", file.string()));
  std::vector<SeriesEntry> entries;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    entries.push_back(to_entry(*collection->GetNestedElement(k), k, file));
  }
  return entries;
}

/// Some texts cannot be put in XML at all (control characters, broken UTF-8): found by reading what would be
/// written.
void check_survives(const std::vector<SeriesEntry>& entries, const std::string& text, const path& file) {
  for (const auto& entry : entries) {
    if (!std::isfinite(entry.time)) {
      throw FileError(fmt::format("{}: cannot be written: the entry '{}' has time {}, which is not finite",
                                  file.string(), entry.file, entry.time));
    }
  }
  const auto back = parse(text, file);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k >= back.size() || back[k].file != entries[k].file || back[k].time != entries[k].time) {
      throw FileError(fmt::format("{}: cannot be written: the entry '{}' does not survive in XML",
                                  file.string(), entries[k].file));
    }
  }
}

[[noreturn]] void refuse_time(const SeriesEntry& entry, const std::string& why, const path& file) {
  throw FileError(fmt::format(
      "{}: cannot be written: the entry '{}' has time {}, {}; of two entries of one time ParaView "
      "shows the first only",
      file.string(), entry.file, entry.time, why));
}

void check_times_differ(const std::vector<SeriesEntry>& entries, const path& file) {
  std::map<double, const SeriesEntry*> known;
  for (const auto& entry : entries) {
    const auto [other, is_new] = known.emplace(entry.time, &entry);
    if (!is_new) refuse_time(entry, fmt::format("as has '{}'", other->second->file), file);
  }
}

void check_is_later(const SeriesEntry& entry, double last, const path& file) {
  if (!(entry.time > last)) refuse_time(entry, fmt::format("and the one before it {}", last), file);
}

/// The time of the last entry by the end of a file as write_series writes it, -infinity if there is no entry;
/// none if the end is not of that form, as of a file that a person has edited.
std::optional<double> last_time(std::string_view end) {
  if (!end.ends_with(closing)) return std::nullopt;
  end.remove_suffix(closing.size());
  if (end.ends_with("  <Collection>\n")) return -std::numeric_limits<double>::infinity();
  const auto begin = end.rfind(before_time);
  if (begin == std::string_view::npos || end.find('\n', begin) != end.size() - 1) return std::nullopt;
  double time = 0;
  const auto [stop, error] =
      std::from_chars(end.data() + begin + before_time.size(), end.data() + end.size(), time);
  if (error != std::errc() || *stop != '"' || !end.ends_with("/>\n")) return std::nullopt;
  return time;
}

/// Writes the series anew with one more entry.
void rewrite_with(const path& file, const SeriesEntry& entry) {
  auto entries = read_series(file);
  if (!entries.empty()) check_is_later(entry, entries.back().time, file);
  entries.push_back(entry);
  write_series(file, entries);
}

}  // namespace

void write_series(const path& file, const std::vector<SeriesEntry>& entries) {
  const auto text = to_xml(entries);
  check_survives(entries, text, file);
  check_times_differ(entries, file);
  write_text(file, text);
}

std::vector<SeriesEntry> read_series(const path& file) {
  return parse(read_growing_text(file, "Collection"), file);
}

void append_to_series(const path& file, const SeriesEntry& entry) {
  check_survives({entry}, to_xml({entry}), file);
  constexpr std::size_t enough =
      8192;  // for an entry with the longest name that Linux takes, even escaped in part
  FileTail tail(file, enough);
  const auto last = last_time(tail.text());
  if (!last) return rewrite_with(file, entry);
  check_is_later(entry, *last, file);
  if (!tail.replace(closing.size(), to_line(entry).append(closing))) rewrite_with(file, entry);
}

}  // namespace tanktread::exchange
