// What a function of a whole surface asks of its arrays. Internal to the coupler.
#pragma once

#include <span>
#include <string>

namespace tanktread::coupler {

/// @param n_others numbers of another array of the nodes, `others` in the message
/// @throws std::invalid_argument unless both arrays are of 3 numbers a node, and the triangles name nodes
/// that exist
void require_surface(std::size_t n_positions, std::span<const int> triangles, const std::string& others,
                     std::size_t n_others);

}  // namespace tanktread::coupler
