#include "membrane/orientation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tanktread::membrane {
namespace {

/// Twice the area of the triangle a, b, c; positive if it turns left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Adds the points to one half of the hull, from left to right or back, without those that turn right.
template <class Points>
void add_half(const Points& points, std::vector<Eigen::Vector2d>& hull) {
  const auto begin = hull.size();
  for (const auto& point : points) {
    while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
    hull.push_back(point);
  }
}

/// The corners of the convex hull (Andrew's monotone chain); the first and last may be there twice.
std::vector<Eigen::Vector2d> hull_of(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Eigen::Vector2d> hull;
  add_half(points, hull);
  std::ranges::reverse(points);
  add_half(points, hull);
  return hull;
}

}  // namespace

double extent_along(const Eigen::Ref<const Eigen::Matrix3Xd>& points, const Eigen::Vector3d& direction) {
  const Eigen::VectorXd along = points.transpose() * direction;
  return along.maxCoeff() - along.minCoeff();
}

double largest_extent_across(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Eigen::Vector3d& direction) {
  const Eigen::Vector3d u = direction.unitOrthogonal(), v = direction.cross(u);
  std::vector<Eigen::Vector2d> shadow;
  for (Eigen::Index node = 0; node < points.cols(); ++node) {
    const Eigen::Vector3d arm = points.col(node) - points.col(0);  // which keeps digits far from the origin
    shadow.emplace_back(arm.dot(u), arm.dot(v));
  }
  const auto hull = hull_of(std::move(shadow));
  double largest = 0;
  for (std::size_t k = 0; k < hull.size(); ++k)
    for (std::size_t m = 0; m < k; ++m) largest = std::max(largest, (hull[k] - hull[m]).norm());
  return largest;
}

Eigen::Vector3d carried_direction(const Eigen::Ref<const Eigen::Matrix3Xd>& start,
                                  const Eigen::Ref<const Eigen::VectorXd>& areas,
                                  const Eigen::Vector3d& direction,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  if (start.cols() != points.cols() || start.cols() != areas.size())
    throw std::invalid_argument("carried direction: start, areas and points must be of the same nodes");
  const Eigen::Vector3d start_mean = start * areas / areas.sum(), mean = points * areas / areas.sum();
  const Eigen::Matrix3Xd from = start.colwise() - start_mean, to = points.colwise() - mean;
  const Eigen::Matrix3d moment = from * areas.asDiagonal() * from.transpose();
  const Eigen::Vector3d dual = moment.llt().solve(direction);
  const Eigen::VectorXd weight = areas.array() * (from.transpose() * dual).array();
  return to * weight;
}

Eigen::Vector3d shortest_axis(const VolumeMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments.second_moment);
  const auto& values = principal.eigenvalues();  // ascending
  constexpr double rounding = 1e-12;
  if (values[1] - values[0] < rounding * values[2]) return Eigen::Vector3d::Zero();
  return principal.eigenvectors().col(0);
}

}  // namespace tanktread::membrane
