// The membranes of a case in files: one, or pieces where they have many triangles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "driver/system/membrane_files.hpp"
#include "exchange/surface_pieces.hpp"

namespace tanktread::driver {

/// Which files are written of a large case.
enum class FileSizes {
  whole,    ///< one a time
  by_case,  ///< in pieces where output.whole_file_nodes and output.whole_file_triangles ask for them
};

/// Capsules that follow one another.
struct CapsuleRange {
  std::size_t first = 0, end = 0;
};

/// The capsules of each piece: they follow one another, and have `most` triangles at most (one that has more
/// is a piece by itself). So pieces do not depend on who writes them. No capsules: one empty range.
std::vector<CapsuleRange> ranges_of_pieces(std::span<const std::int64_t> n_triangles, std::int64_t most);

/// Membranes to be written.
struct SurfacesToWrite {
  std::filesystem::path file;  ///< without an ending: .vtu, or .pvtu with pieces in the folder of that name
  bool is_state = false;       ///< with all that they need to go on
  std::int64_t most_triangles = std::numeric_limits<std::int64_t>::max();  ///< of a file
};

/// The content of a file of these capsules.
exchange::SurfacePacket surface_to_write(const CapsulesNow& capsules, const MembraneArrays& arrays,
                                         bool is_state);

/// The file of the piece, of so many: of one the file itself.
std::filesystem::path file_of_piece(const std::filesystem::path& file, std::size_t piece,
                                    std::size_t n_pieces);
/// Writes the index of pieces that are there. @param first the content of the first one
/// @throws exchange::FileError
void write_index_of_pieces(const std::filesystem::path& file, const exchange::SurfacePacket& first,
                           std::size_t n_pieces);

/// Writes all capsules of a case. @throws exchange::FileError
void write_surfaces(const SurfacesToWrite& what, const CapsulesNow& capsules);

/// output.whole_file_triangles of a case, or no bound.
std::int64_t most_triangles(const Case& the_case, FileSizes sizes);

}  // namespace tanktread::driver
