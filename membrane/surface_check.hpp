// Whether a surface of triangles is still one that its energies can be taken of: not folded up, no needles.
#pragma once

#include <Eigen/Core>

#include "membrane/surface_edges.hpp"

namespace tanktread::membrane {

/// What a membrane that crumples comes to step by step, each of them a good one for ElementCheck, which
/// compares an element with itself a step before: here it is compared with its neighbours, and with an
/// equilateral one.
class SurfaceCheck {
 public:
  /// Two triangles at an edge have folded up if their normals are further apart. At 180 degrees the angle of
  /// an edge, and the energy of bending with it, jumps from one sign to the other. A node that moves by a
  /// tenth of an edge turns an even triangle by about 0.1/(sqrt(3)/2) radians, and the fold by at most twice
  /// as much if both are turned, 13 degrees: in such steps none goes through 180 unseen. With longer steps,
  /// or where triangles are smaller than their mean or flat, one may; it is seen if it stays beyond 160.
  static constexpr double greatest_fold_deg = 160;
  /// Height of a triangle over its longest edge, 0.87 if it is equilateral. One below this has an angle of at
  /// most atan(2 * 0.02) = 2.3 degrees; its cotangent, which the forces of bending have, is 25 and more, and
  /// what the nodes do is no longer of the surface.
  static constexpr double least_height = 0.02;

  /// @param triangles closed and wound the same way
  explicit SurfaceCheck(Eigen::Matrix3Xi triangles);

  /// Looks at all triangles, then all edges. @param positions 3 x n_nodes
  /// @throws InvertedElement that names the first one that is wrong, its nodes, place, and by how much
  void check(const Eigen::Matrix3Xd& positions);

 private:
  Eigen::Matrix3Xi triangles_;
  SurfaceEdges edges_;
  Eigen::Matrix3Xd normal_;  ///< scratch of check(): unit, a column a triangle
};

}  // namespace tanktread::membrane
