#include "driver/diff/file_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "driver/diff/packet_difference.hpp"
#include "driver/diff/series_difference.hpp"
#include "driver/diff/table_difference.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/file_system_error.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/surface_pieces.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw exchange::FileError(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

void compare_bytes(const fs::path& a, const fs::path& b, DifferenceReport& report) {
  const auto text_a = bytes_of(a), text_b = bytes_of(b);
  if (text_a == text_b) return;
  const auto first = std::mismatch(text_a.begin(), text_a.end(), text_b.begin(), text_b.end()).first;
  report.add(fmt::format("{} bytes against {}; first difference at byte {}, in line {}", text_a.size(),
                         text_b.size(), first - text_a.begin(), 1 + std::count(text_a.begin(), first, '\n')));
}

bool leaves_out(const std::string& name, DifferenceReport& report) {
  const auto last = fs::path(name).filename().string();
  return report.leaves_out(name) || (last != name && report.leaves_out(last));
}

/// `name` says which kind of file both are, and stands in the report.
void compare_files(const std::string& name, const fs::path& a, const fs::path& b, DifferenceReport& report) {
  report.begin_file(name);
  const auto kind = fs::path(whole_name(name)).extension();
  if (kind == ".vtu") return compare_surfaces(a, b, report);
  if (kind == ".vti") return compare_grids(a, b, report);
  if (kind == ".csv") return compare_tables(a, b, report);
  if (kind == ".pvd") return compare_series(exchange::read_series(a), exchange::read_series(b), report);
  compare_bytes(a, b, report);
}

/// The files below a directory: their relative names, by what they are called. A grid or surface in pieces
/// is called as one that is whole, and has the name of its index.
struct Listing {
  fs::path directory;
  std::map<std::string, std::string> names;

  void add(const std::string& name) {
    const auto [there, is_new] = names.emplace(whole_name(name), name);
    if (is_new || there->second == name) return;
    // One is whole and one an index, which is called as it is then.
    const auto index = there->first == name ? there->second : name;
    there->second = there->first;
    names.emplace(index, index);
  }
};

void compare_listings(const Listing& a, const Listing& b, DifferenceReport& report) {
  std::set<std::string> all;
  for (const auto* listing : {&a, &b})
    for (const auto& [name, file] : listing->names) all.insert(name);
  for (const auto& name : all) {
    if (leaves_out(name, report)) continue;
    if (a.names.contains(name) && b.names.contains(name)) {
      compare_files(name, a.directory / a.names.at(name), b.directory / b.names.at(name), report);
      continue;
    }
    report.begin_file(name);
    report.add(a.names.contains(name) ? "only in the first" : "only in the second");
  }
}

/// The pieces that a file names, relative to it; none if it is no index.
std::vector<std::string> pieces_of(const fs::path& file) {
  std::vector<std::string> names;
  if (file.extension() == ".pvtu") names = exchange::read_surface_index(file).pieces;
  if (file.extension() == ".pvti") {
    for (const auto& piece : exchange::read_grid_index(file).pieces) names.push_back(piece.file);
  }
  return names;
}

Listing files_below(const fs::path& directory) {
  std::set<std::string> files, pieces;
  for (fs::recursive_directory_iterator entry(directory), end; entry != end; ++entry) {
    if (entry->path().filename().string().starts_with('.')) {
      entry.disable_recursion_pending();
    } else if (!entry->is_directory()) {
      files.insert(entry->path().lexically_relative(directory).string());
      // They are compared as what they are together.
      for (const auto& piece : pieces_of(entry->path()))
        pieces.insert((entry->path().parent_path() / piece).lexically_relative(directory).string());
    }
  }
  Listing listing{directory, {}};
  for (const auto& file : files) {
    if (!pieces.contains(file)) listing.add(file);
  }
  return listing;
}

Listing files_named_by(const fs::path& series) {
  Listing listing{series.parent_path(), {}};
  for (const auto& entry : exchange::read_series(series)) listing.add(entry.file);
  return listing;
}

void require_one_kind(const fs::path& a, const fs::path& b) {
  for (const auto& path : {a, b}) {
    if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file or directory", path.string()));
  }
  if (fs::is_directory(a) != fs::is_directory(b)) {
    const auto& directory = fs::is_directory(a) ? a : b;
    throw InputError(fmt::format("{}: is a directory and {} is not; compare two files or two directories",
                                 directory.string(), (fs::is_directory(a) ? b : a).string()));
  }
  if (!fs::is_directory(a) && fs::path(whole_name(a)).extension() != fs::path(whole_name(b)).extension()) {
    throw InputError(
        fmt::format("{} and {} are files of two kinds, by the endings of their names; compare two of one",
                    a.string(), b.string()));
  }
}

}  // namespace

DifferenceReport compare_outputs(const fs::path& a, const fs::path& b, const DifferenceOptions& options) try {
  require_one_kind(a, b);
  DifferenceReport report(options);
  if (fs::is_directory(a)) {
    compare_listings(files_below(a), files_below(b), report);
  } else {
    compare_files(a.string(), a, b, report);
    if (a.extension() == ".pvd") compare_listings(files_named_by(a), files_named_by(b), report);
  }
  return report;
} catch (const exchange::FileError& error) {
  throw InputError(error.what());
} catch (const fs::filesystem_error& error) {
  throw InputError(message_of(error));
}

}  // namespace tanktread::driver
