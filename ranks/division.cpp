#include "ranks/division.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tanktread::ranks {
namespace {

constexpr int n_axes = 3;
constexpr std::array<const char*, n_axes> axis_names = {"x", "y", "z"};

std::string text(const Triple& numbers) {
  return std::to_string(numbers[0]) + " x " + std::to_string(numbers[1]) + " x " + std::to_string(numbers[2]);
}

/// Parts that an axis can be cut into: the smallest of p has floor(n/p) nodes.
int most_parts(const Box& box, int axis) {
  return std::max(1, box.n[axis] / std::max(1, box.least[axis]));
}

/// The divisors of n that are at most `most`, in order.
std::vector<int> divisors(int n, int most) {
  std::vector<int> small, large;
  for (int k = 1; k <= n / k; ++k) {
    if (n % k != 0) continue;
    if (k <= most) small.push_back(k);
    if (n / k != k && n / k <= most) large.push_back(n / k);
  }
  small.insert(small.end(), large.rbegin(), large.rend());
  return small;
}

/// All ways to cut the box into `n_ranks` parts, with few along x first, then along y.
std::vector<Triple> ways(const Box& box, int n_ranks) {
  std::vector<Triple> found;
  for (const int x : divisors(n_ranks, most_parts(box, 0))) {
    const int layer = n_ranks / x;
    for (const int y : divisors(layer, most_parts(box, 1)))
      if (layer / y <= most_parts(box, 2)) found.push_back({x, y, layer / y});
  }
  return found;
}

}  // namespace

Division::Division(const Box& box, const Triple& parts) : box_(box), parts_(parts) {
  for (int axis = 0; axis < n_axes; ++axis) {
    const int most = most_parts(box, axis);
    if (parts[axis] >= 1 && parts[axis] <= most) continue;
    throw std::invalid_argument(std::to_string(parts[axis]) + " parts along " + axis_names[axis] +
                                " of a box of " + text(box.n) + " nodes: must be 1 to " +
                                std::to_string(most) + ", so that each has " +
                                std::to_string(box.least[axis]) + " nodes at least");
  }
}

int Division::begin(int axis, int part) const {
  return static_cast<int>(std::int64_t{part} * box_.n[axis] / parts_[axis]);
}

Triple Division::place(int rank) const {
  return {rank % parts_[0], rank / parts_[0] % parts_[1], rank / parts_[0] / parts_[1]};
}

Block Division::block(int rank) const {
  const Triple at = place(rank);
  Block block;
  for (int axis = 0; axis < n_axes; ++axis) {
    block.begin[axis] = begin(axis, at[axis]);
    block.n[axis] = begin(axis, at[axis] + 1) - block.begin[axis];
  }
  return block;
}

int Division::owner(const Triple& node) const {
  Triple at;
  for (int axis = 0; axis < n_axes; ++axis) {
    // The last part k with floor(k n/p) <= node, that is k n < (node + 1) p.
    at[axis] = static_cast<int>(((node[axis] + std::int64_t{1}) * parts_[axis] - 1) / box_.n[axis]);
  }
  return (at[2] * parts_[1] + at[1]) * parts_[0] + at[0];
}

std::optional<int> Division::neighbour(int rank, const Triple& direction) const {
  Triple at = place(rank);
  for (int axis = 0; axis < n_axes; ++axis) {
    const int moved = at[axis] + direction[axis];
    if (!box_.periodic[axis] && (moved < 0 || moved >= parts_[axis])) return std::nullopt;
    at[axis] = (moved + parts_[axis]) % parts_[axis];
  }
  return (at[2] * parts_[1] + at[1]) * parts_[0] + at[0];
}

std::int64_t Division::cut_surface() const {
  std::int64_t surface = 0;
  for (int axis = 0; axis < n_axes; ++axis) {
    if (parts_[axis] == 1) continue;  // a periodic axis in one piece is closed within the rank
    const std::int64_t n_cuts = parts_[axis] - (box_.periodic[axis] ? 0 : 1);
    surface += n_cuts * box_.n[(axis + 1) % n_axes] * box_.n[(axis + 2) % n_axes];
  }
  return surface;
}

Division least_surface(const Box& box, int n_ranks) {
  std::optional<Division> best;
  for (const Triple& parts : ways(box, n_ranks)) {
    const Division division(box, parts);
    if (!best || division.cut_surface() < best->cut_surface()) best = division;
  }
  if (best) return *best;
  // No number beyond the most parts along each axis can be, and that one can.
  const std::int64_t most = std::int64_t{most_parts(box, 0)} * most_parts(box, 1) * most_parts(box, 2);
  int fewer = static_cast<int>(std::clamp<std::int64_t>(n_ranks - std::int64_t{1}, 0, most));
  while (fewer > 1 && ways(box, fewer).empty()) --fewer;
  throw std::invalid_argument("a box of " + text(box.n) + " nodes cannot be divided among " +
                              std::to_string(n_ranks) + " ranks, with " + text(box.least) +
                              " nodes a rank at least; " + std::to_string(std::max(1, fewer)) + " would do");
}

}  // namespace tanktread::ranks
