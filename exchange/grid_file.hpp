// One file of a grid, whole or a piece.
#pragma once

#include <filesystem>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// As read_grid (vtk_files.hpp), but with the place of a piece in its whole: `begin` as the file has it, and
/// the origin of the whole.
GridPacket read_piece(const std::filesystem::path& file, bool convert);

}  // namespace tanktread::exchange
