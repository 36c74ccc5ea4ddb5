// Packets as VTK files: .vtu (triangles), .vti (grids), .pvd (series in time).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// A file could not be read or written, or is not what it should be. The message names the file, what is
/// wrong, and VTK's own words.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a packet as appended raw doubles, which keep every bit (NaN, inf and subnormals too). The file is
/// written under a temporary name beside its place and then renamed, so that a reader never sees half a file.
/// @throws FileError
void write_surface(const std::filesystem::path& file, const SurfacePacket& packet);
void write_grid(const std::filesystem::path& file, const GridPacket& packet);

/// Reads a packet back; arrays of other types than double are refused unless `convert` is set (files made
/// elsewhere).
/// @throws FileError (missing, not that kind of file, cells that are not triangles, ...)
SurfacePacket read_surface(const std::filesystem::path& file, bool convert = false);
GridPacket read_grid(const std::filesystem::path& file, bool convert = false);

/// One entry of a .pvd: a file, by its path relative to the .pvd, and its time (in shear times).
struct SeriesEntry {
  double time;
  std::string file;
};
/// Writes a .pvd collection (temporary name, then rename). A series that is continued is read first, then
/// written whole.
void write_series(const std::filesystem::path& file, const std::vector<SeriesEntry>& entries);
std::vector<SeriesEntry> read_series(const std::filesystem::path& file);

/// Writes any text under a temporary name, then renames it into place. @throws FileError
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace tanktread::exchange
