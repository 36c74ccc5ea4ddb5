#include "membrane/node_areas.hpp"

#include <Eigen/Geometry>

namespace tanktread::membrane {

Eigen::VectorXd node_areas(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const Eigen::Ref<const Eigen::Matrix3Xi>& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d origin = points.col(triangles(0, t));
    const Eigen::Vector3d along = points.col(triangles(1, t)) - origin;
    const Eigen::Vector3d across = points.col(triangles(2, t)) - origin;
    const double sixth = along.cross(across).norm() / 6.0;  // a third of the area
    for (int corner = 0; corner < 3; ++corner) areas[triangles(corner, t)] += sixth;
  }
  return areas;
}

}  // namespace tanktread::membrane
