// Vectors of many triangles, or edges, side by side, so that the compiler computes several at once. Internal
// to the membrane component.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace tanktread::membrane {

/// Triangles, and edges, are computed in blocks of this size, whatever the number of threads. A block that is
/// not full repeats its last one. Of 16, 32 and 64 this is the fastest: what a block needs stays near.
inline constexpr int n_lanes = 16;

struct alignas(64) Lanes : std::array<double, n_lanes> {};

/// A vector in each lane.
struct VectorLanes {
  Lanes x, y, z;

  void set(int lane, const double* vector) {
    x[lane] = vector[0];
    y[lane] = vector[1];
    z[lane] = vector[2];
  }
};

/// A block of things that are counted from 0 to n.
struct LaneBlock {
  int begin, size;

  LaneBlock(int number, int n) : begin(number * n_lanes), size(std::min(n_lanes, n - begin)) {}
  int thing(int lane) const { return begin + std::min(lane, size - 1); }
};

inline int n_lane_blocks(int n) {
  return (n + n_lanes - 1) / n_lanes;
}

}  // namespace tanktread::membrane
