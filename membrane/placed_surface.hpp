// A closed surface at its place: how near another one is, and what lies inside it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "membrane/mesh.hpp"
#include "membrane/triangle_distance.hpp"

namespace tanktread::membrane {

/// A copy of a mesh with a tree of boxes around its triangles, so that a question looks at few of them. The
/// tree is made at the first question that needs it: not to be asked by two threads at once.
class PlacedSurface {
 public:
  /// @param mesh closed and wound outwards, with at least one triangle, all points finite
  explicit PlacedSurface(const TriangleMesh& mesh);
  ~PlacedSurface();
  PlacedSurface(PlacedSurface&&) noexcept;
  PlacedSurface& operator=(PlacedSurface&&) noexcept;

  /// The box around its nodes.
  const Eigen::AlignedBox3d& box() const;

  /// Where it is nearest to another surface: to its triangles, not to its nodes only. Nothing: it is nowhere
  /// nearer than `within`, which is found out sooner than how near it is.
  /// @param shift by which the other one is moved first, as to its periodic image
  std::optional<NearestPlace> nearest_to(const PlacedSurface& other, const Eigen::Vector3d& shift,
                                         double within) const;

  /// The point lies inside: the surface covers more than half of what is seen from there. Where the surface
  /// is near, the answer is that of rounding.
  bool encloses(const Eigen::Vector3d& point) const;
  /// All of another surface lies inside. Of two that do not cut through each other one node tells.
  bool encloses(const PlacedSurface& other, const Eigen::Vector3d& shift) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanktread::membrane
