// The shapes that the membranes of a case are made from.
#pragma once

#include <vector>

#include "driver/packets/packets.hpp"
#include "membrane/mesh.hpp"

namespace tanktread::driver {

/// The shapes that the membranes of a case are made from, one each a capsule.
struct MembraneShapes {
  std::vector<membrane::TriangleMesh> meshes;  ///< as they start
  NodeVectors stress_free;                     ///< the nodes of `meshes` where they have no elastic stress

  /// What membrane::Membrane takes.
  membrane::TriangleMesh reference(std::size_t capsule) const {
    return {stress_free[capsule], meshes[capsule].triangles};
  }
};

}  // namespace tanktread::driver
