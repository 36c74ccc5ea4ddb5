// The blocks of compressed arrays, looked at before VTK's reader takes their number on trust.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

class vtkXMLDataParser;

namespace tanktread::exchange {

/// A compressed array begins with three words: its number of blocks, and the lengths of a block and of the
/// last one as they will be. VTK makes and fills lists of so many blocks, and a block of such a length,
/// before it reads on: checks that a file of `n_bytes` can hold the list, and a block.
/// @param stream the file that `parser` has parsed
/// @throws FileError naming the array
void check_compressed_blocks(vtkXMLDataParser& parser, std::istream& stream, std::uint64_t n_bytes,
                             const std::filesystem::path& file);

}  // namespace tanktread::exchange
