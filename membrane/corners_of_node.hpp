// From element corners to nodes: which corners meet in a node, and the sum of what they carry.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace tanktread::membrane {

/// For every node the element corners that meet in it, in ascending order of 3 element + corner. Nodes gather
/// from their corners, so threads never write to the same place and the order of a sum never changes.
class CornersOfNode {
 public:
  /// @param triangles 3 x n_triangles, node indices from 0 to n_nodes - 1
  CornersOfNode(const Eigen::Matrix3Xi& triangles, Eigen::Index n_nodes)
      : begin_(n_nodes + 1, 0), corner_(triangles.size()) {
    const int* node_of_corner = triangles.data();
    for (Eigen::Index k = 0; k < triangles.size(); ++k) ++begin_[node_of_corner[k] + 1];
    for (Eigen::Index node = 0; node < n_nodes; ++node) begin_[node + 1] += begin_[node];
    auto next = begin_;
    for (Eigen::Index k = 0; k < triangles.size(); ++k) corner_[next[node_of_corner[k]]++] = k;
  }

  /// The corners of a node, 3 element + corner; empty if no triangle has it.
  std::span<const Eigen::Index> of(Eigen::Index node) const {
    return {corner_.data() + begin_[node], corner_.data() + begin_[node + 1]};
  }

  /// @param of_corners 3 x 3 n_triangles, a column a corner
  Eigen::Vector3d sum(const Eigen::Matrix3Xd& of_corners, Eigen::Index node) const {
    return sum_of(node, [&](Eigen::Index corner) { return of_corners.col(corner); });
  }

  /// The same of what of_corner(3 element + corner) returns, a vector.
  template <class OfCorner>
  Eigen::Vector3d sum_of(Eigen::Index node, const OfCorner& of_corner) const {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (Eigen::Index k = begin_[node]; k < begin_[node + 1]; ++k) result += of_corner(corner_[k]);
    return result;
  }

 private:
  std::vector<Eigen::Index> begin_;   ///< into corner_, n_nodes + 1 entries
  std::vector<Eigen::Index> corner_;  ///< 3 element + corner
};

}  // namespace tanktread::membrane
