// The shapes of the capsules of a case, one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "driver/system/capsule_shape.hpp"

namespace tanktread::driver {

/// How large the mesh of a capsule is.
struct MeshSize {
  Eigen::Index n_nodes = 0, n_triangles = 0;
};
inline MeshSize size_of(const membrane::TriangleMesh& mesh) {
  return {mesh.points.cols(), mesh.triangles.cols()};
}

/// One each a mesh.
inline std::vector<MeshSize> sizes_of(const std::vector<membrane::TriangleMesh>& meshes) {
  std::vector<MeshSize> sizes;
  for (const auto& mesh : meshes) sizes.push_back(size_of(mesh));
  return sizes;
}

/// Gives the shape of a capsule of a case whenever it is asked for: a copy of one that is held, or one that
/// is made again. So what looks at all capsules, one after the other, need not hold them all.
using ShapeSource = std::function<CapsuleShape(std::size_t capsule)>;

/// Made by capsule_shape(). @param the_case borrowed
inline ShapeSource made_shapes(const Case& the_case) {
  return [&the_case](std::size_t capsule) { return capsule_shape(the_case, capsule); };
}

}  // namespace tanktread::driver
