// Packets as VTK files: .vtu (triangles), .vti (grids), .pvd (series in time).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// Writes a packet as appended raw doubles, which keep every bit (NaN, inf and subnormals too), with a hash
/// of all of it in one more array of field data, `content_hash` (content_hash.hpp). The file is written under
/// a temporary name beside its place, brought to the disk, and renamed, so that a reader never sees half a
/// file; if anything fails the old file stays and the temporary one goes. The packet is not copied.
/// @throws FileError if the file cannot be written or the packet is not what packet.hpp says: wrong number of
/// values, node numbers that are not there, names that are empty, repeated or not printable ASCII without < >
/// & ", or kept for what writing adds (field data `content_hash`, `padding_for_meshio`)
void write_surface(const std::filesystem::path& file, const SurfacePacket& packet);
void write_grid(const std::filesystem::path& file, const GridPacket& packet);

/// Reads a packet back, the arrays in the order in which they were written. If the file has a hash, its
/// contents must be those that it was made of; one without, as other programs write, is taken as it is.
/// `convert` is for files made elsewhere: with it numbers of other types are widened to double and text is
/// left out; without it both are errors, and so are numbers written as ASCII, which need not keep every bit.
/// @throws FileError if the file is missing, cut off, damaged (a single changed bit) or of another kind; for
/// a surface, cells that are not triangles; for a grid, axes that are turned or cell data; with `convert`,
/// integers of 2^53 and more, which a double does not hold
/// A grid is given by itself: origin is the position of its first node, whatever number the file gives that,
/// and begin 0. A name that ends with .pvti or .pvtu is that of an index (grid_pieces.hpp,
/// surface_pieces.hpp), whose pieces are put together: of surfaces one after the other, and after the field
/// data of the index those that a piece has of its own.
SurfacePacket read_surface(const std::filesystem::path& file, bool convert = false);
GridPacket read_grid(const std::filesystem::path& file, bool convert = false);

/// The same for a packet that another program computed from one of ours, and from which a run goes on:
/// integers are widened and text is left out, but numbers that have lost digits are errors, which are those
/// of single precision and real numbers written as text (ASCII). A hash is left out unread: a program that
/// adds arrays to what it was given keeps the hash of that.
/// @throws FileError as above
SurfacePacket read_exact_surface(const std::filesystem::path& file);
GridPacket read_exact_grid(const std::filesystem::path& file);

/// One entry of a .pvd: a file, by its path relative to the .pvd, and its time (in shear times).
struct SeriesEntry {
  double time;
  std::string file;
};
/// Writes a .pvd collection (temporary name, then rename). Times are written with 17 significant digits,
/// which name one double only, and one double has one text.
/// @throws FileError, also for a time that is not finite, two entries of one time (ParaView shows the first
/// of them only) and a name that XML cannot hold (control characters, broken UTF-8)
void write_series(const std::filesystem::path& file, const std::vector<SeriesEntry>& entries);
/// Adds an entry to a .pvd that is there, later than all it has; the file then is as write_series makes it.
/// The new line and the closing tags go over the old closing tags in one write, so that the cost does not
/// grow with the series. It is written anew where it does not end as write_series ends it (another program or
/// a person wrote it) and while read_series reads it. If the disk is full the old series stays. A process
/// that is killed, or a power cut, in the midst of that write may leave a series that is cut off, which
/// read_series refuses.
/// @throws FileError as write_series, and for a time that is not later than that of the last entry
void append_to_series(const std::filesystem::path& file, const SeriesEntry& entry);
/// The entries in the order of the file, which is whole also while append_to_series adds to it.
/// @throws FileError
std::vector<SeriesEntry> read_series(const std::filesystem::path& file);

/// Writes any text under a temporary name, then renames it into place. @throws FileError
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace tanktread::exchange
