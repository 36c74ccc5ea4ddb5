#include "membrane/surface_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "membrane/membrane.hpp"

namespace tanktread::membrane {
namespace {

std::ostringstream message_on(const Eigen::Vector3d& place) {
  std::ostringstream message;
  const Eigen::IOFormat list(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ");
  message << "at (" << place.transpose().format(list) << ") ";
  return message;
}

[[noreturn]] void refuse_triangle(Eigen::Index triangle, const Eigen::Vector3i& nodes,
                                  const Eigen::Vector3d& place, double height) {
  auto message = message_on(place);
  message << "membrane element " << triangle << " (nodes " << nodes[0] << ", " << nodes[1] << ", " << nodes[2]
          << ") ";
  if (std::isfinite(height)) {
    message << "has become a needle: its height is " << height << " of its longest edge, at least "
            << SurfaceCheck::least_height << " is allowed";
  } else {
    message << "has no area, or a position that is not finite";
  }
  throw InvertedElement(message.str());
}

[[noreturn]] void refuse_edge(const SurfaceEdges& edges, int edge, const Eigen::Vector3d& place,
                              double cosine) {
  auto message = message_on(place);
  message << "the membrane has folded up: the elements " << edges.left[edge] << " and " << edges.right[edge]
          << " at the edge of the nodes " << edges.from[edge] << " and " << edges.to[edge]
          << " have normals that are " << std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi
          << " degrees apart, at most " << SurfaceCheck::greatest_fold_deg << " are allowed";
  throw InvertedElement(message.str());
}

}  // namespace

SurfaceCheck::SurfaceCheck(Eigen::Matrix3Xi triangles)
    : triangles_(std::move(triangles)), edges_(triangles_), normal_(3, triangles_.cols()) {}

void SurfaceCheck::check(const Eigen::Matrix3Xd& positions) {
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    const Eigen::Vector3i nodes = triangles_.col(t);
    const Eigen::Vector3d a = positions.col(nodes[0]), b = positions.col(nodes[1]),
                          c = positions.col(nodes[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double twice_area = normal.norm();
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double height = twice_area / longest;
    if (!(height >= least_height)) refuse_triangle(t, nodes, (a + b + c) / 3, height);
    normal_.col(t) = normal / twice_area;
  }
  const double least_cosine = std::cos(greatest_fold_deg * std::numbers::pi / 180);
  for (int edge = 0; edge < edges_.size(); ++edge) {
    const double cosine = normal_.col(edges_.left[edge]).dot(normal_.col(edges_.right[edge]));
    if (cosine >= least_cosine) continue;
    refuse_edge(edges_, edge, (positions.col(edges_.from[edge]) + positions.col(edges_.to[edge])) / 2,
                cosine);
  }
}

}  // namespace tanktread::membrane
