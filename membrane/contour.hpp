// The curve in which a plane across an axis cuts a surface of triangles: its length, and the mean speed along
// it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tanktread::membrane {

/// A point on an edge, in shares of what its two ends have: (1 - share) `low` + share `high`.
struct EdgePoint {
  int low = 0, high = 0;  ///< nodes, low < high: both triangles of an edge find the same point, to the bit
  double share = 0;       ///< in [0, 1]

  /// The point itself, or a velocity there (linear along the edge). @param values 3 x n_nodes
  Eigen::Vector3d of(const Eigen::Ref<const Eigen::Matrix3Xd>& values) const {
    return (1 - share) * values.col(low) + share * values.col(high);
  }
};

/// The part of a contour that lies in one triangle: a straight line, of no length where it only touches a
/// node.
struct ContourPiece {
  EdgePoint begin, end;
};

/// The contour in the plane x[axis] = at. A node on the plane counts as above it; so each edge is cut once or
/// not at all, for both of its triangles alike, and the pieces of a closed surface make closed curves. There
/// may be several of them (a folded surface) or none: all are in the list, one triangle after the other, and
/// length and mean are of all together.
/// @param points 3 x n_nodes @param triangles 3 x n_triangles @param axis 0, 1 or 2
std::vector<ContourPiece> contour(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                  const Eigen::Ref<const Eigen::Matrix3Xi>& triangles, int axis, double at);

/// C, the sum of the lengths of the pieces, in the unit of the points; 0 of none.
double contour_length(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const std::vector<ContourPiece>& pieces);

/// (1/C) times the integral along the contour of |v - `frame`| without its part along `axis`; of a piece by
/// the trapezoidal rule, as good as the triangles. 0 if C is.
/// @param velocity v, 3 x n_nodes
/// @param frame a velocity that is taken off, of the centroid for example
double mean_speed(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                  const Eigen::Ref<const Eigen::Matrix3Xd>& velocity, const std::vector<ContourPiece>& pieces,
                  int axis, const Eigen::Vector3d& frame);

}  // namespace tanktread::membrane
