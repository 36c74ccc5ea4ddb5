// Two packets compared bit for bit, array by array.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// How one array of a packet differs from that of the same name in another.
struct ArrayDifference {
  std::string
      kind;  ///< "points", "triangles", "geometry" (of grids), "point data", "cell data", "field data"
  std::string name;
  /// Why no values are compared: "only in the first", "only in the second", "2562 x 3 against 642 x 3"
  /// (tuples x components); "" if they are.
  std::string problem;
  std::int64_t n_values = 0;
  std::int64_t n_different = 0;  ///< in any bit: 0.0 and -0.0 differ, NaN and the same NaN do not
  std::int64_t first = 0;        ///< index of the first value that differs (tuple = first / components)
  int components = 1;
  double first_a = 0, first_b = 0;  ///< both values there
  /// Largest |a - b|, and the root of the mean of (a - b)^2 over all values. Values of the same bits count as
  /// 0, a NaN against anything else as NaN, which max and rms then are too.
  double max = 0, rms = 0;
  std::int64_t largest =
      0;  ///< index of the value where |a - b| is largest; of the first NaN if there is one

  bool identical() const { return problem.empty() && n_different == 0; }
};

/// Of two lists of values of the same length.
ArrayDifference value_difference(const std::string& kind, const std::string& name, int components,
                                 std::span<const double> a, std::span<const double> b);

/// Of all arrays of two packets, identical ones too: geometry first, then in the order of `a`, then what only
/// `b` has. Arrays belong together by kind and name; in which order a packet has them does not matter.
/// Geometry is "points" and "triangles" of a surface, "nodes", "origin" and "spacing" of a grid.
std::vector<ArrayDifference> differences(const SurfacePacket& a, const SurfacePacket& b);
std::vector<ArrayDifference> differences(const GridPacket& a, const GridPacket& b);

}  // namespace tanktread::exchange
