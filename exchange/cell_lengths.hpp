// The offsets of the cells of a .vtu, looked at before VTK's reader takes the last one on trust.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

class vtkXMLDataParser;

namespace tanktread::exchange {

/// The last offset of a piece's cells is the number of node numbers that VTK makes room for before it looks
/// for them: checks that a file of `n_bytes` can hold so many. Counts and compressed blocks must have been
/// checked before.
/// @param stream the file that `parser` has parsed
/// @throws FileError naming the offset
void check_cell_lengths(vtkXMLDataParser& parser, std::istream& stream, std::uint64_t n_bytes,
                        const std::filesystem::path& file);

}  // namespace tanktread::exchange
