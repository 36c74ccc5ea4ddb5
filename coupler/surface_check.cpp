#include "coupler/surface_check.hpp"

#include <stdexcept>

namespace tanktread::coupler {

void require_surface(std::size_t n_positions, std::span<const int> triangles, const std::string& others,
                     std::size_t n_others) {
  if (n_positions % 3 != 0 || n_others != n_positions) {
    throw std::invalid_argument("coupler: positions of " + std::to_string(n_positions) + " and " + others +
                                " of " + std::to_string(n_others) + " numbers, must both be 3 a node");
  }
  if (triangles.size() % 3 != 0) {
    throw std::invalid_argument("coupler: triangles of " + std::to_string(triangles.size()) +
                                " numbers, must be 3 a triangle");
  }
  for (const int node : triangles) {
    if (node >= 0 && static_cast<std::size_t>(node) < n_positions / 3) continue;
    throw std::invalid_argument("coupler: a triangle names node " + std::to_string(node) + " of " +
                                std::to_string(n_positions / 3));
  }
}

}  // namespace tanktread::coupler
