// Closed surfaces of triangles for the tests of what is inside them, and a way to tell that needs no rows.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coupler/inside.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::test {

/// Counter-clockwise seen from outside.
struct Surface {
  Numbers positions;
  std::vector<int> triangles;
};

/// A unit sphere: an icosahedron whose triangles are cut in four `level` times.
Surface icosphere(int level);
/// Half axes along x, y, z.
Surface ellipsoid(int level, const Vector& half_axes);
/// A red cell at rest (Evans and Fung 1972, doi 10.1016/0026-2862(72)90069-6) around the axis z.
Surface biconcave_disc(int level, double radius);
/// A bowl with a mouth at the top that is narrower than the bowl: a sphere folded into one.
Surface stomatocyte(int level, double radius, double thickness);
/// Of 12 triangles. The diagonals of opposite faces are the same.
Surface box(const Vector& least, const Vector& greatest);
/// Corners at `radius` from the centre along the axes.
Surface octahedron(const Vector& centre, double radius);
/// Corners in any order.
Surface tetrahedron(const std::array<Vector, 4>& corners);

/// Turned by an angle about an axis through the origin (of any length), then moved.
Surface placed(Surface surface, const Vector& axis, double angle, const Vector& centre);
/// Turned and moved at random, the same in every run of the test.
Surface placed_at_random(const Surface& surface, const Vector& least, const Vector& greatest, unsigned seed);
Surface moved(Surface surface, const Vector& distance);
/// Its inside out.
Surface turned_over(Surface surface);

/// The arguments of InsideMarks::mark() that some surfaces make.
struct Spans {
  explicit Spans(const std::vector<Surface>& surfaces);
  std::vector<std::span<const double>> positions;
  std::vector<std::span<const int>> triangles;
};

using Marks = std::vector<std::int32_t>;

/// By mark() of a new InsideMarks.
Marks marks_of(const Grid& grid, const std::vector<Surface>& surfaces, int threads = 1);
/// How many have a mark that is not 0.
std::int64_t number_inside(const Marks& marks);

/// What the marks must be, by solid angles: w = 1/(4 pi) sum over triangles of Omega (van Oosterom and
/// Strackee 1983, doi 10.1109/TBME.1983.325207), to the nearest whole number, of each surface and its
/// periodic images, up to one period off. -1: in more than one.
Marks marks_by_solid_angles(const Grid& grid, const std::vector<Surface>& surfaces);

}  // namespace tanktread::coupler::test
