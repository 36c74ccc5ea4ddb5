// Which grid nodes are inside which surface.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// A surface that is not closed, has its inside out, or shares a node with itself, its periodic image or
/// another; one whose positions are not finite, too far off, or spread over more than two periods. The
/// message says surface and place.
class InsideError : public std::runtime_error {
 public:
  explicit InsideError(const std::string& message, std::uint64_t the_precedence = 0)
      : std::runtime_error(message), precedence(the_precedence) {}
  /// As of a StencilError: of those of all parts of a grid, the lowest is that of the whole grid.
  std::uint64_t precedence = 0;
};

/// Marks the grid nodes inside closed surfaces of triangles, which are counter-clockwise seen from outside.
///
/// A node is inside where the winding number of the surface is 1: the row of grid nodes along x that it is in
/// has come into the surface once more than it has left it. Each surface is cut with the planes z = k + 1/2,
/// the cuts, closed polygons, with the lines y = j + 1/2. What a triangle tells is said by its edges only,
/// and an edge says the same to both of its triangles, whatever is rounded: no row ever enters without
/// leaving. Only nodes within rounding of the surface may be on the wrong side of it.
///
/// A node on the surface counts as if it were a little further along x, by far less along y, and by far less
/// again along z: of a box the faces at the lesser x, y and z are inside, those at the greater ones outside.
/// So two surfaces that share the triangles between them, at the same positions to the last bit, mark each
/// grid node there once.
///
/// Surface positions may lie anywhere on a periodic axis (they need not be wrapped), and a surface may go
/// across its faces. What is beyond a wall is left out. A hole that no row passes through is not seen, nor an
/// overlap with no node in it, nor one that is shorter along a row than 1e-9 grid steps, which rounding
/// makes.
///
/// The cost is that of the triangles and of the rows that meet them, not of the grid.
///
/// It may hold a part of the grid: then the marks of the nodes there are those of the whole grid, and no rows
/// but those of the part are looked at. Surfaces are given whole, or, where they are far from the part,
/// without nodes and triangles. Messages name nodes by their place in the grid.
class InsideMarks {
 public:
  /// @param threads OpenMP threads, 0: all. Marks do not depend on their number
  /// @throws std::invalid_argument if an axis has no node, or threads is negative
  explicit InsideMarks(const Grid& grid, int threads = 0);
  /// Of a part of the grid.
  /// @throws std::invalid_argument also if the part has no nodes or is not within the grid
  InsideMarks(const Grid& grid, const GridPart& part, int threads = 0);
  ~InsideMarks();

  /// Marks all nodes anew, by a sweep over the whole grid, or the part. Whatever it throws, the old marks and
  /// changes stay.
  /// @param positions, triangles one span a surface: 3 numbers a node, 3 node numbers a triangle
  /// @throws InsideError of the first surface, and of it the first row, where something is wrong; then of the
  /// first node in two surfaces
  /// @throws std::invalid_argument if they are not of the same number of surfaces, a size is no multiple of 3
  /// or a triangle names a node that does not exist
  void mark(std::span<const std::span<const double>> positions,
            std::span<const std::span<const int>> triangles);

  /// The same marks as mark() for the same arguments, but only nodes whose mark changes are written. The
  /// surfaces may have moved by any distance, and be others.
  void update(std::span<const std::span<const double>> positions,
              std::span<const std::span<const int>> triangles);

  /// 0: outside of all; k + 1: inside surface k. One a node of the grid or the part, x fastest; it stays
  /// where it is.
  std::span<const std::int32_t> marks() const;

  struct Change {
    std::int64_t node;  ///< linear index, in the part
    std::int32_t before, now;
  };
  /// What the last mark() or update() changed, ascending by node, until the next call. Before the first call
  /// all marks are 0.
  std::span<const Change> changes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanktread::coupler
