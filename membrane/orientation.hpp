// How long a surface is along a direction and across it, and which way it points.
#pragma once

#include <Eigen/Core>

#include "membrane/shape.hpp"

namespace tanktread::membrane {

/// Greatest less least place of a node along a direction, in the unit of the points.
/// @param points 3 x n_nodes, at least one @param direction of length 1
double extent_along(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const Eigen::Vector3d& direction);

/// The largest of the extents along all directions across the given one: the diameter (the largest distance
/// of two points) of the shadow that the nodes cast along it. Of a disc that is pulled in its plane that is
/// its width in that plane.
/// @param points as above @param direction of length 1
double largest_extent_across(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Eigen::Vector3d& direction);

/// Where the nodes have carried a direction of their start: F times it, with F the linear map that takes the
/// nodes from start to points best, by least squares weighted with their areas, whatever they are shifted
/// by:
///
///     F = [sum A (x - x_m)(X - X_m)^T] [sum A (X - X_m)(X - X_m)^T]^-1,   x_m, X_m the means weighted by A.
///
/// Turned as a body it turns with it; where the membrane goes round a shape that stays (tank-treading) it
/// goes round with the membrane. Its length is the mean stretch along it.
/// @param start X, 3 x n_nodes, not in one plane @param areas A, an entry a node @param points x, 3 x n_nodes
/// @throws std::invalid_argument if sizes differ
Eigen::Vector3d carried_direction(const Eigen::Ref<const Eigen::Matrix3Xd>& start,
                                  const Eigen::Ref<const Eigen::VectorXd>& areas,
                                  const Eigen::Vector3d& direction,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& points);

/// The shortest axis of the ellipsoid of these moments (Deformation), of length 1 and either sign. Zero where
/// the two shortest differ by less than 1e-12 of the longest: it would be one of rounding.
Eigen::Vector3d shortest_axis(const VolumeMoments& moments);

}  // namespace tanktread::membrane
