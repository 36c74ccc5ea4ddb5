// One file of a surface, whole or a piece. Internal to exchange/.
#pragma once

#include <filesystem>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// How the numbers of a file are taken (vtk_files.hpp).
enum class Reading {
  as_written,  ///< as read_surface does: doubles, of which the hash must be the file's
  converted,   ///< as read_surface does with `convert`
  exact,       ///< as read_exact_surface does
};

/// As read_surface and read_exact_surface, but of a .vtu only. @throws FileError as they do
SurfacePacket read_surface_file(const std::filesystem::path& file, Reading reading);

}  // namespace tanktread::exchange
