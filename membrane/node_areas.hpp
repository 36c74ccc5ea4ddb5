// The share of a surface that each of its nodes has.
#pragma once

#include <Eigen/Core>

namespace tanktread::membrane {

/// A third of the area of the triangles around each node, in the square of the points' unit; an entry a node.
/// They add up to the area of the surface, which may be open. 0 for a node without triangles.
/// @param points 3 x n_nodes
/// @param triangles 3 x n_triangles
Eigen::VectorXd node_areas(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const Eigen::Ref<const Eigen::Matrix3Xi>& triangles);

}  // namespace tanktread::membrane
