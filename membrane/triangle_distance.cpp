#include "membrane/triangle_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

namespace tanktread::membrane {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Segment {
  Vector3d start, along;
};

Segment edge_of(const Matrix3d& triangle, int number) {
  return {triangle.col(number), triangle.col((number + 1) % 3) - triangle.col(number)};
}

Vector3d normal_of(const Matrix3d& triangle) {
  return (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
}

/// A point in the plane of a triangle lies within it.
bool holds(const Matrix3d& triangle, const Vector3d& normal, const Vector3d& point) {
  for (int corner = 0; corner < 3; ++corner) {
    const auto edge = edge_of(triangle, corner);
    if (edge.along.cross(point - edge.start).dot(normal) < 0) return false;
  }
  return true;
}

/// Where an edge goes through a triangle. One within its plane does not: its distance is that to the edges.
std::optional<Vector3d> crossing(const Segment& edge, const Matrix3d& triangle, const Vector3d& normal) {
  const double start = normal.dot(edge.start - triangle.col(0)), change = normal.dot(edge.along);
  if (change == 0) return std::nullopt;
  const double part = -start / change;
  if (!(part >= 0 && part <= 1)) return std::nullopt;
  const Vector3d point = edge.start + part * edge.along;
  if (!holds(triangle, normal, point)) return std::nullopt;
  return point;
}

void take_nearer(NearestPlace& nearest, const Vector3d& a, const Vector3d& b) {
  const double distance = (a - b).norm();
  if (distance < nearest.distance) nearest = {distance, 0.5 * (a + b)};
}

/// |p + s d - q - t e| is least at the s where both derivatives vanish; where that lies beyond an end, at the
/// end.
void take_nearer(NearestPlace& nearest, const Segment& a, const Segment& b) {
  const Vector3d apart = a.start - b.start;
  const double dd = a.along.squaredNorm(), ee = b.along.squaredNorm(), de = a.along.dot(b.along);
  const double dr = a.along.dot(apart), er = b.along.dot(apart);
  const double determinant = dd * ee - de * de;
  double s = determinant > 0 ? std::clamp((de * er - dr * ee) / determinant, 0.0, 1.0) : 0.0;
  const double wanted = (de * s + er) / ee, t = std::clamp(wanted, 0.0, 1.0);
  if (t != wanted) s = std::clamp((de * t - dr) / dd, 0.0, 1.0);
  take_nearer(nearest, a.start + s * a.along, b.start + t * b.along);
}

/// A corner above the face of a triangle.
void take_nearer(NearestPlace& nearest, const Vector3d& corner, const Matrix3d& triangle,
                 const Vector3d& normal) {
  const Vector3d foot = corner - normal * (normal.dot(corner - triangle.col(0)) / normal.squaredNorm());
  if (holds(triangle, normal, foot)) take_nearer(nearest, corner, foot);
}

}  // namespace

NearestPlace nearest_place(const Matrix3d& a, const Matrix3d& b) {
  const Vector3d normal_a = normal_of(a), normal_b = normal_of(b);
  NearestPlace nearest{(a.col(0) - b.col(0)).norm(), 0.5 * (a.col(0) + b.col(0))};
  for (int k = 0; k < 3; ++k) {
    const auto edge = edge_of(a, k);
    if (const auto point = crossing(edge, b, normal_b)) return {0.0, *point};
    if (const auto point = crossing(edge_of(b, k), a, normal_a)) return {0.0, *point};
    for (int other = 0; other < 3; ++other) take_nearer(nearest, edge, edge_of(b, other));
    take_nearer(nearest, a.col(k), b, normal_b);
    take_nearer(nearest, b.col(k), a, normal_a);
  }
  return nearest;
}

}  // namespace tanktread::membrane
