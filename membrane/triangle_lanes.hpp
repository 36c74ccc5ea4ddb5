// Numbers of many triangles, or edges, side by side, so that the compiler computes several at once. Internal
// to the membrane component.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace tanktread::membrane {

/// Triangles, and edges, are computed in blocks of this size, whatever the number of threads. A block that is
/// not full repeats its last one. Steps with blocks of 8 and of 32 cost the same to a few hundredths.
inline constexpr int n_lanes = 16;

struct alignas(64) Lanes : std::array<double, n_lanes> {};
struct alignas(64) IndexLanes : std::array<int, n_lanes> {};

/// A block of things that are counted from 0 to n.
struct LaneBlock {
  int begin, size;

  LaneBlock(int number, int n) : begin(number * n_lanes), size(std::min(n_lanes, n - begin)) {}
  int thing(int lane) const { return begin + std::min(lane, size - 1); }
};

inline int n_lane_blocks(int n) {
  return (n + n_lanes - 1) / n_lanes;
}

/// `n_rows` numbers a thing: block after block, in each its rows one after the other. So loops over a block
/// read and write neighbouring numbers, and all numbers of a thing are near for one that reads them by
/// offset_of().
template <int n_rows>
class LaneTable {
 public:
  explicit LaneTable(int n_things) : numbers_(n_lane_blocks(n_things) * n_rows * n_lanes) {}

  double* row(int block, int row) { return numbers_.data() + (block * n_rows + row) * n_lanes; }
  const double* row(int block, int row) const { return numbers_.data() + (block * n_rows + row) * n_lanes; }

  const double* data() const { return numbers_.data(); }
  /// Where a number of a thing is in data(); that of the next row is n_lanes further.
  static int offset_of(int thing, int row) {
    return (thing / n_lanes * n_rows + row) * n_lanes + thing % n_lanes;
  }

 private:
  Eigen::ArrayXd numbers_;
};

/// Numbers of a block out of an array that has no more than the things; lanes without one are zero.
inline Lanes lanes_of(const double* numbers, const LaneBlock& block) {
  Lanes lanes{};
  std::copy_n(numbers + block.begin, block.size, lanes.begin());
  return lanes;
}

/// The sum over a block, always in the same order: halves upon each other.
inline double sum_of(Lanes lanes, const LaneBlock& block) {
  std::fill(lanes.begin() + block.size, lanes.end(), 0.0);
  for (int half = n_lanes / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) lanes[i] += lanes[half + i];
  return lanes[0];
}

/// A vector of one lane.
struct LaneVector {
  double x, y, z;

  /// @param at where in `numbers` its first component is; the others are n_lanes apart, as rows of a
  /// LaneTable
  static LaneVector of_rows(const double* numbers, int at) {
    return {numbers[at], (numbers + n_lanes)[at], (numbers + 2 * n_lanes)[at]};
  }
  /// The same in three places one after the other.
  static LaneVector of_points(const double* numbers, int at) {
    return {numbers[at], (numbers + 1)[at], (numbers + 2)[at]};
  }
  void put(double* rows, int lane) const {
    rows[lane] = x;
    rows[lane + n_lanes] = y;
    rows[lane + 2 * n_lanes] = z;
  }

  double dot(const LaneVector& b) const { return x * b.x + y * b.y + z * b.z; }
  LaneVector cross(const LaneVector& b) const {
    return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
  }
  friend LaneVector operator+(const LaneVector& a, const LaneVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend LaneVector operator-(const LaneVector& a, const LaneVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend LaneVector operator*(double factor, const LaneVector& a) {
    return {factor * a.x, factor * a.y, factor * a.z};
  }
};

}  // namespace tanktread::membrane
