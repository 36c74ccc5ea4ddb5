// Surfaces put together to one.
#pragma once

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// Adds the points, triangles and data of another surface behind those of the first, with the same arrays of
/// point and cell data; of field data what the first one lacks.
/// @param to may be empty: it is the other one then
/// @throws std::invalid_argument if they have not the same arrays
void append_surface(SurfacePacket& to, SurfacePacket other);

}  // namespace tanktread::exchange
