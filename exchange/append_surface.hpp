// Surfaces put together to one.
#pragma once

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// Adds the points, triangles and data of another surface behind those of the first one. Field data stay as
/// they are.
/// @throws std::invalid_argument if the other one lacks an array of the first one; the first is then of no
/// use
void append_surface(SurfacePacket& to, const SurfacePacket& other);

}  // namespace tanktread::exchange
