// Normals of the nodes of surfaces of triangles.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tanktread::coupler {

/// Unit normals of the nodes: the sum over the triangles around of u x v/(|u|^2 |v|^2), u and v their edges
/// at the node (Max 1999, doi:10.1080/10867651.1999.10487501), exact where the nodes around lie on a sphere.
/// Weighted by area alone they would lean towards the larger triangles, and nodes that move normal to them
/// would make a capsule swell (docs/kernels.md).
/// @param positions, normals 3 numbers a node @param triangles 3 node numbers a triangle
/// @param normals overwritten; not a number where a node has no triangle, its triangles' normals cancel or
/// two nodes of a triangle are one
/// @throws std::invalid_argument if the sizes do not fit, or a triangle names a node that does not exist
void node_normals(std::span<const double> positions, std::span<const int> triangles,
                  std::span<double> normals);

/// The same for all surfaces, step after step: which triangles are around a node is found once, normals of
/// positions that are still those of the last call are not found again, and all threads share the nodes of
/// all surfaces. Results do not depend on their number, to the last bit.
class NodeNormals {
 public:
  /// @param threads OpenMP threads, 0: all @throws std::invalid_argument if it is negative
  explicit NodeNormals(int threads = 0);

  /// @param positions, triangles one span a surface, as of node_normals(). Triangles that are not those of
  /// the last call are taken in anew
  /// @return the normals, one span a surface, until the next call
  /// @throws std::invalid_argument as node_normals(), or if they are not of the same number of surfaces
  std::span<const std::span<const double>> find(std::span<const std::span<const double>> positions,
                                                std::span<const std::span<const int>> triangles);

 private:
  /// The triangles of a surface, sorted by the nodes that they are around.
  struct Surface {
    std::vector<int> triangles;
    std::vector<std::size_t> first_corner;  ///< corners of the nodes before each; at the end, of all
    std::vector<int> others;                ///< the next two nodes of the triangle of each corner
  };

  bool knows(std::size_t surface, std::size_t n_nodes, std::span<const int> triangles) const;
  static void take_in(std::size_t n_nodes, std::span<const int> triangles, Surface& surface);
  bool take_in_positions(std::span<const std::span<const double>> positions);

  int n_threads_;
  std::vector<Surface> surfaces_;
  std::vector<std::size_t> first_node_ = {0};  ///< nodes before each surface; at the end, of all
  std::vector<double> positions_;              ///< that normals_ are of
  std::vector<double> normals_;                ///< of all surfaces
  std::vector<std::span<const double>> of_surface_;
};

}  // namespace tanktread::coupler
