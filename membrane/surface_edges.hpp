// The edges of a closed surface of triangles.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

namespace tanktread::membrane {

/// Edges in the order of their first triangles. Side k of triangle t, number 3 t + k, goes from its corner k
/// to the next.
struct SurfaceEdges {
  std::vector<int> from, to;     ///< the nodes of an edge
  std::vector<int> left, right;  ///< its triangles: the left one runs from `from` to `to`, the right one back
  std::vector<int> of_side;      ///< the edge of a side

  /// @param triangles closed and wound the same way
  explicit SurfaceEdges(const Eigen::Matrix3Xi& triangles) : of_side(triangles.size()) {
    std::map<std::pair<int, int>, int> edge_of;
    for (int t = 0; t < triangles.cols(); ++t) {
      for (int corner = 0; corner < 3; ++corner) {
        const int a = triangles(corner, t), b = triangles((corner + 1) % 3, t);
        const auto [entry, is_new] = edge_of.try_emplace(std::minmax(a, b), size());
        of_side[3 * t + corner] = entry->second;
        if (is_new) {
          from.push_back(a);
          to.push_back(b);
          left.push_back(t);
          right.push_back(-1);
        } else {
          right[entry->second] = t;
        }
      }
    }
  }

  int size() const { return static_cast<int>(from.size()); }
};

}  // namespace tanktread::membrane
