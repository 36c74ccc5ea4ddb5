#include "membrane/placed_surface.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "membrane/element.hpp"

namespace tanktread::membrane {
namespace {

using Box = Eigen::AlignedBox3d;
/// Boxes around triangles by their numbers, in pairs, and pairs of these, up to the whole.
using Tree = Eigen::KdBVH<double, 3, int>;

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    Box box;
    for (int corner = 0; corner < 3; ++corner) box.extend(mesh.points.col(mesh.triangles(corner, t)));
    boxes.push_back(box);
  }
  return boxes;
}

Tree tree_of(const std::vector<Box>& boxes) {
  std::vector<int> numbers(boxes.size());
  for (std::size_t t = 0; t < numbers.size(); ++t) numbers[t] = static_cast<int>(t);
  return {numbers.begin(), numbers.end(), boxes.begin(), boxes.end()};
}

}  // namespace

struct PlacedSurface::Implementation {
  TriangleMesh mesh;
  std::vector<Box> boxes;  ///< of the triangles
  Box whole;
  std::unique_ptr<Tree> tree;  ///< null: not asked for yet

  explicit Implementation(const TriangleMesh& a_mesh) : mesh(a_mesh), boxes(boxes_of(mesh)) {
    for (const auto& box : boxes) whole.extend(box);
  }

  const Tree& made_tree() {
    if (!tree) tree = std::make_unique<Tree>(tree_of(boxes));
    return *tree;
  }

  Eigen::Matrix3d triangle(int t) const { return corners_of(mesh.points, mesh.triangles.col(t)); }
};

namespace {

/// What Eigen::BVMinimize asks of two trees: how near boxes and triangles are, at least. What is not nearer
/// than the nearest place so far is infinitely far, so that no one looks into it.
template <class Surface>
struct NearestTriangles {
  using Scalar = double;
  const Surface& first;
  const Surface& second;
  Eigen::Vector3d shift;  ///< of the second one
  NearestPlace nearest;   ///< at first as far as anyone looks

  double minimumOnVolumeVolume(const Box& a, const Box& b) const {
    const double distance = a.exteriorDistance(b.translated(shift));
    return distance < nearest.distance ? distance : std::numeric_limits<double>::max();
  }
  double minimumOnObjectVolume(int a, const Box& b) const { return minimumOnVolumeVolume(first.boxes[a], b); }
  double minimumOnVolumeObject(const Box& a, int b) const {
    return minimumOnVolumeVolume(a, second.boxes[b]);
  }
  double minimumOnObjectObject(int a, int b) {
    const double at_least = minimumOnVolumeVolume(first.boxes[a], second.boxes[b]);
    if (at_least >= nearest.distance) return at_least;
    const auto found = nearest_place(first.triangle(a), second.triangle(b).colwise() + shift);
    if (found.distance < nearest.distance) nearest = found;
    return found.distance;
  }
};

/// The solid angle at which a triangle is seen, positive from its inner side (van Oosterom and Strackee 1983,
/// doi 10.1109/TBME.1983.325207).
double solid_angle(const Eigen::Matrix3d& seen) {
  const Eigen::Vector3d a = seen.col(0), b = seen.col(1), c = seen.col(2);
  const double na = a.norm(), nb = b.norm(), nc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
}

}  // namespace

PlacedSurface::PlacedSurface(const TriangleMesh& mesh)
    : implementation_(std::make_unique<Implementation>(mesh)) {}
PlacedSurface::~PlacedSurface() = default;
PlacedSurface::PlacedSurface(PlacedSurface&&) noexcept = default;
PlacedSurface& PlacedSurface::operator=(PlacedSurface&&) noexcept = default;

const Eigen::AlignedBox3d& PlacedSurface::box() const {
  return implementation_->whole;
}

std::optional<NearestPlace> PlacedSurface::nearest_to(const PlacedSurface& other,
                                                      const Eigen::Vector3d& shift, double within) const {
  if (box().exteriorDistance(other.box().translated(shift)) >= within) return std::nullopt;
  NearestTriangles<Implementation> minimizer{
      *implementation_, *other.implementation_, shift, {within, Eigen::Vector3d::Zero()}};
  Eigen::BVMinimize(implementation_->made_tree(), other.implementation_->made_tree(), minimizer);
  if (minimizer.nearest.distance >= within) return std::nullopt;
  return minimizer.nearest;
}

bool PlacedSurface::encloses(const Eigen::Vector3d& point) const {
  if (!box().contains(point)) return false;
  const auto& mesh = implementation_->mesh;
  double seen = 0;
  for (int t = 0; t < mesh.triangles.cols(); ++t)
    seen += solid_angle(implementation_->triangle(t).colwise() - point);
  return seen > 2 * std::numbers::pi;
}

bool PlacedSurface::encloses(const PlacedSurface& other, const Eigen::Vector3d& shift) const {
  return box().contains(other.box().translated(shift)) &&
         encloses(other.implementation_->mesh.points.col(0) + shift);
}

}  // namespace tanktread::membrane
