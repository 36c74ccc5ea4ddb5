// What of a surface hangs together.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tanktread::membrane {

/// The number of the part that each triangle belongs to: triangles hang together by edges of just two
/// triangles, not by nodes alone. Parts are numbered from 0, by their first triangles.
/// @param triangles 3 x n, node numbers from 0
std::vector<int> parts_of(const Eigen::Matrix3Xi& triangles);

/// Nodes whose triangles are more than one fan (triangles about it that hang together by edges): there
/// surfaces touch that would part if they were pulled.
int count_pinched_nodes(const Eigen::Matrix3Xi& triangles);

}  // namespace tanktread::membrane
