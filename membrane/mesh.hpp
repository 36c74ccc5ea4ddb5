// Closed surfaces of triangles: making them, and saying what they are like.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tanktread::membrane {

/// A surface of triangles. Points in grid steps (or any unit), one column a node; triangles as columns of
/// node indices, counter-clockwise seen from outside.
struct TriangleMesh {
  Eigen::Matrix3Xd points;
  Eigen::Matrix3Xi triangles;
};

/// A sphere from an icosahedron, each triangle split in four `level` times, nodes pushed out to the sphere:
/// 20 * 4^level triangles, 10 * 4^level + 2 nodes; the nodes of a level are the first ones of the next level.
/// Level 3 is the thesis's Mesh #2, 4 its #3, 5 its #4.
/// @throws std::invalid_argument unless 0 <= level <= 8 and radius > 0
TriangleMesh icosphere(int level, double radius, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

/// A part of a surface that hangs together by edges.
struct MeshPart {
  int n_triangles = 0;
  int euler_characteristic = 0;
  double volume = 0;  ///< as MeshReport::volume
};

/// What `tanktread mesh info` prints.
struct MeshReport {
  int n_nodes = 0, n_triangles = 0, n_edges = 0;
  double edge_min = 0, edge_mean = 0, edge_max = 0;
  double area = 0;                  ///< of the triangles
  double volume = 0;                ///< enclosed, by the divergence theorem; negative if wound inside out
  Eigen::Vector3d centre;           ///< centroid of the enclosed volume; without meaning if open
  bool closed = false;              ///< every edge has exactly two triangles
  bool consistent_winding = false;  ///< neighbours run through their shared edge in opposite directions
  bool outward = false;             ///< closed, consistently wound, volume > 0
  int n_unused_nodes = 0;           ///< nodes of no triangle
  int n_degenerate = 0;             ///< triangles whose area is below 1e-12 of edge_max squared
  int n_pinched_nodes = 0;          ///< nodes at which surfaces touch: their triangles are not one fan
  int euler_characteristic = 0;     ///< nodes - edges + triangles; 2 for a sphere; adds up over parts
  std::vector<MeshPart> parts;      ///< at least one, in the order of their first triangles
};
/// @throws std::invalid_argument if the mesh has no triangle, a triangle names a node that does not exist, or
/// a point is not finite
MeshReport inspect(const TriangleMesh& mesh);

/// Reasons why the mesh cannot be a capsule's membrane, each a sentence with the fix; empty if it can.
std::vector<std::string> defects(const MeshReport& report);

}  // namespace tanktread::membrane
