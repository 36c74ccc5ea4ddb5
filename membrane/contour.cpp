#include "membrane/contour.hpp"

#include <algorithm>

namespace tanktread::membrane {
namespace {

double length_of(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const ContourPiece& piece) {
  return (piece.end.of(points) - piece.begin.of(points)).norm();
}

}  // namespace

std::vector<ContourPiece> contour(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                  const Eigen::Ref<const Eigen::Matrix3Xi>& triangles, int axis, double at) {
  const auto is_above = [&](int node) { return points(axis, node) >= at; };
  const auto cut = [&](int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const double to_plane = at - points(axis, low);
    return EdgePoint{low, high, to_plane / (points(axis, high) - points(axis, low))};
  };
  std::vector<ContourPiece> pieces;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const int alone = triangles(corner, t), next = triangles((corner + 1) % 3, t),
                last = triangles((corner + 2) % 3, t);
      // The corner that is on one side of the plane by itself, if there is one.
      if (is_above(alone) == is_above(next) || is_above(alone) == is_above(last)) continue;
      pieces.push_back({cut(alone, next), cut(alone, last)});
    }
  }
  return pieces;
}

double contour_length(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const std::vector<ContourPiece>& pieces) {
  double length = 0;
  for (const auto& piece : pieces) length += length_of(points, piece);
  return length;
}

double mean_speed(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                  const Eigen::Ref<const Eigen::Matrix3Xd>& velocity, const std::vector<ContourPiece>& pieces,
                  int axis, const Eigen::Vector3d& frame) {
  const auto speed_at = [&](const EdgePoint& point) {
    Eigen::Vector3d relative = point.of(velocity) - frame;
    relative[axis] = 0;
    return relative.norm();
  };
  double length = 0, integral = 0;
  for (const auto& piece : pieces) {
    const double of_piece = length_of(points, piece);
    length += of_piece;
    integral += of_piece * 0.5 * (speed_at(piece.begin) + speed_at(piece.end));
  }
  return length > 0 ? integral / length : 0.0;
}

}  // namespace tanktread::membrane
