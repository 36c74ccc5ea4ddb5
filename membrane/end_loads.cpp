#include "membrane/end_loads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "membrane/node_areas.hpp"

namespace tanktread::membrane {
namespace {

/// Of the length along the axis: far above the rounding of a node's place (some 1e-15 of its distance from
/// the origin), far below the distance of two nodes.
constexpr double tie = 1e-9;

/// @param along places of the nodes on the axis @param needed area
EndPatch patch_at_end(const TriangleMesh& mesh, const Eigen::VectorXd& along, const Eigen::VectorXd& areas,
                      double needed) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(along.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, [&](Eigen::Index a, Eigen::Index b) { return along[a] > along[b]; });
  // A share that nodes make up exactly is not to be missed by rounding.
  constexpr double rounding = 1e-12;
  double area = 0;
  std::size_t n_taken = 0;
  while (n_taken < order.size() && area < (1 - rounding) * needed) area += areas[order[n_taken++]];
  const double last = along[order[std::max<std::size_t>(n_taken, 1) - 1]];
  const double nearest = last - tie * (along.maxCoeff() - along.minCoeff());
  EndPatch patch;
  for (Eigen::Index node = 0; node < along.size(); ++node)
    if (along[node] >= nearest) patch.nodes.push_back(node);
  patch.share.resize(std::ssize(patch.nodes));
  for (Eigen::Index k = 0; k < patch.share.size(); ++k) patch.share[k] = areas[patch.nodes[k]];
  patch.area = patch.share.sum();
  patch.share /= patch.area;
  patch.width = along.maxCoeff() - last;
  patch.centroid.setZero();
  for (Eigen::Index k = 0; k < patch.share.size(); ++k)
    patch.centroid += patch.share[k] * mesh.points.col(patch.nodes[k]);
  return patch;
}

void add_forces_of(const EndPatch& patch, const Eigen::Vector3d& force, Eigen::Matrix3Xd& forces) {
  for (Eigen::Index k = 0; k < patch.share.size(); ++k) forces.col(patch.nodes[k]) += patch.share[k] * force;
}

}  // namespace

double EndPatches::offset() const {
  return direction.cross(ahead.centroid - behind.centroid).norm();
}

EndPatches end_patches(const TriangleMesh& mesh, const Eigen::Vector3d& direction, double share) {
  if (!direction.allFinite() || direction.isZero(0))
    throw std::invalid_argument("end loads: the direction must be finite and not zero");
  if (!(share > 0 && share <= 0.5)) {
    throw std::invalid_argument("end loads: a patch of " + std::to_string(share) +
                                " of the area, must be above 0 and at most 0.5");
  }
  inspect(mesh);
  const auto areas = node_areas(mesh.points, mesh.triangles);
  EndPatches patches;
  patches.direction = direction.stableNormalized();
  patches.mesh_area = areas.sum();
  const Eigen::VectorXd along = mesh.points.transpose() * patches.direction;
  const double needed = share * patches.mesh_area;
  patches.ahead = patch_at_end(mesh, along, areas, needed);
  patches.behind = patch_at_end(mesh, -along, areas, needed);
  return patches;
}

Eigen::Matrix3Xd end_forces(const EndPatches& patches, double force, Eigen::Index n_nodes) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, n_nodes);
  add_forces_of(patches.ahead, force * patches.direction, forces);
  add_forces_of(patches.behind, -force * patches.direction, forces);
  return forces;
}

}  // namespace tanktread::membrane
