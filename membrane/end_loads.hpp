// Forces on patches of nodes at the two ends of a surface, which pull it apart or press it together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "membrane/mesh.hpp"

namespace tanktread::membrane {

/// Nodes at an end of a surface, between which a force is shared out.
struct EndPatch {
  std::vector<Eigen::Index> nodes;  ///< ascending
  Eigen::VectorXd share;            ///< of the force, an entry a node of the patch: its area over `area`
  double area = 0;                  ///< sum of node_areas()
  double width = 0;                 ///< along the axis, from the farthest node of the patch to the nearest
  Eigen::Vector3d centroid;         ///< sum of share times position: through it the force acts
};

/// The patches at both ends of an axis, as they are on one mesh.
struct EndPatches {
  Eigen::Vector3d direction;  ///< of the axis, of length 1
  EndPatch ahead, behind;     ///< farthest along the direction; farthest against it
  double mesh_area = 0;

  /// Distance between the lines along which the two forces act. Times a force it is their moment, which is
  /// zero (to rounding) where the axis is one of a symmetry of the mesh that leaves no way to be off it.
  double offset() const;
};

/// The nodes farthest along the direction, taken one after the other until their node_areas() make up `share`
/// of the whole; and those farthest against it. Nodes whose places along the axis differ by less than 1e-9 of
/// the length of the mesh along it are equally far: with one of them all are taken, so that no order decides
/// between them and a patch is as symmetric as its mesh. A patch has at least one node, and may so be larger
/// than `share`; two patches with `share` near 1/2 may overlap.
/// @param mesh as the capsule starts @param direction of any length but 0 @param share in (0, 1/2]
/// @throws std::invalid_argument for another direction or share, or for a mesh that inspect() refuses
EndPatches end_patches(const TriangleMesh& mesh, const Eigen::Vector3d& direction, double share);

/// The nodal forces: `force` along the direction shared out over the patch ahead, the opposite over that
/// behind. They add up to zero, to rounding.
/// @param force on each patch; negative: the ends are pressed together
/// @return 3 x n_nodes
Eigen::Matrix3Xd end_forces(const EndPatches& patches, double force, Eigen::Index n_nodes);

}  // namespace tanktread::membrane
