// The border of the coupler: the immersed boundary between surfaces of nodes and a Cartesian grid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tanktread::coupler {

/// The grid as the coupler sees it. Node (i, j, k) sits at (i + 1/2, j + 1/2, k + 1/2); a periodic axis
/// repeats after nodes[axis] steps; an axis that is not periodic has walls at 0 and nodes[axis]. Linear
/// index: x fastest.
struct Grid {
  std::array<int, 3> nodes;
  std::array<bool, 3> periodic;
};

/// A block of the nodes of a grid: begin .. begin + nodes - 1 along each axis.
struct GridPart {
  std::array<int, 3> begin, nodes;
};

/// A discrete delta: the product over axes of a function of the distance in grid steps.
struct Kernel {
  std::string name;         ///< in the case file
  std::string description;  ///< one line: formula, source, which moments it has
  double half_width;        ///< the function is zero at and beyond this distance
  bool first_moment;  ///< sum over nodes of (x - r) phi(x - r) = 0: linear fields are interpolated exactly
  /// Capsules were measured to be nearer to theory with the tangential correction, in all that was looked at
  /// (docs/kernels.md): it is on by default.
  bool gains_by_correction;
  double (*function)(double distance);  ///< phi(r), even in r
  /// For each of n coordinates phi at first_distance, first_distance + 1, ... (ceil(2 half_width) points, in
  /// `weights` one coordinate after the other), where that is cheaper than one by one; null: `function` is
  /// called for each.
  void (*weights)(int n, const double* first_distances, double* weights);
  /// The derivative d phi/dr of those points, likewise; needed by surfaces with a shear dipole only. Where
  /// phi has a kink, that of one side, the same at all points of a phase. Null: such surfaces are refused.
  void (*slopes)(int n, const double* first_distances, double* slopes) = nullptr;
};

/// All kernels, the default (stockie6) first: stockie6, peskin4, cosine4 (Eq. 2.2), roma3, linear2.
const std::vector<Kernel>& kernels();

/// @throws std::invalid_argument that lists the known names
const Kernel& kernel(const std::string& name);

/// A membrane node whose stencil reaches beyond a wall, or whose position or normal is not finite. The
/// message says surface, node, position.
class StencilError : public std::runtime_error {
 public:
  explicit StencilError(const std::string& message, std::uint64_t the_precedence = 0)
      : std::runtime_error(message), precedence(the_precedence) {}
  /// Of the errors that couplers of the parts of a grid throw in the same call, that with the lowest is the
  /// one that a coupler of the whole grid throws.
  std::uint64_t precedence = 0;
};

/// What the stencils of a surface between two fluids have beside the kernel (docs/kernels.md, "Two fluids").
/// A length d other than 0 adds the rate of shear across the surface to the velocity, and a force dipole
/// without a moment, its adjoint, to the force:
///
///     u_m = sum_f [phi u_f + d P (G + G^T) n],    G_cj = (u_f)_c d phi/dx_mj,    P = I - n n^T
///     F_f = sum_m [phi F_m + d (t (n.g) + n (t.g))],    t = P F_m,    g = d phi/dx_m
struct ShearDipole {
  std::span<const double> normals;  ///< unit, outwards, 3 a node; looked at if the length is not 0
  double length = 0;                ///< d, grid steps
};

/// Couples any number of surfaces with one grid. Build the stencils once a step, at x(t): they serve the
/// spread at t and the interpolation of the next step. All arrays: 3 numbers a node, component fastest.
/// Surface positions may lie anywhere on a periodic axis (they need not be wrapped). Results do not depend on
/// the number of threads, to the last bit.
///
/// It may hold a part of the grid. The parts of a grid, each coupled by itself (on a rank, say), together do
/// what one coupler of the whole grid does, to the last bit: each grid node gets its force from the part that
/// it is in, each membrane node its velocity from the part where it is at home. That is the part of the grid
/// cell that the node is in: the whole number below its coordinate, wrapped or held between the walls.
///
/// Contracts: interpolation is consistent (weights sum to 1), spreading conservative (the sum of the forces
/// on the grid is that of the nodal forces), both with the same weights, so that power is conserved.
class Coupler {
 public:
  /// @param threads OpenMP threads, 0: all
  /// @throws std::invalid_argument if an axis has fewer nodes than the kernel is wide, threads is negative,
  /// the kernel's function is null, or its half-width is not above 1/2 and at most 3
  Coupler(const Grid& grid, const Kernel& kernel, int threads = 0);
  /// Of a part of the grid.
  /// @throws std::invalid_argument as that of the whole grid, or if the part has no nodes or is not within
  /// the grid
  Coupler(const Grid& grid, const GridPart& part, const Kernel& kernel, int threads = 0);
  ~Coupler();

  /// The kernel it was made with.
  const Kernel& kernel() const;

  /// The grid nodes that stencils reach which touch the part: the part and, along an axis where it is cut,
  /// as many nodes more on either side as the kernel is wide, less one. It ends at a wall; beyond a periodic
  /// face it goes on, with numbers below 0 or beyond the grid, unless it is as long as the whole axis: then
  /// it is that, from 0 on, with its wrap-around. Of the whole grid, the grid.
  const GridPart& region() const;

  /// Builds the stencils of all surfaces at the positions given (one span of 3 n numbers a surface). Whatever
  /// it throws, the old stencils stay. Only nodes whose stencils touch the part get one, the others cost next
  /// to nothing. A surface of which none does may be given without nodes (so may its dipole's normals be).
  /// @param dipoles one a surface, copied; none: no surface has one
  /// @throws StencilError if a stencil reaches beyond a wall with a weight other than 0, or a position is not
  /// finite or more than 2^30 grid steps from the origin, or the normal of a dipole is not finite; the first
  /// such node is named
  /// @throws std::invalid_argument if the size of a span is no multiple of 3, or dipoles are not one a
  /// surface, have other normals than nodes, a length that is not finite or a kernel without slopes
  /// @throws std::length_error if the stencils touch more than 2^31 - 1 grid nodes
  void build(std::span<const std::span<const double>> surfaces, std::span<const ShearDipole> dipoles = {});

  /// The numbers, ascending, of the nodes of a surface that are at home in the part: all, of the whole grid.
  /// The span is valid until the next build().
  /// @throws std::invalid_argument if there is no such surface
  std::span<const std::int32_t> home_nodes(std::size_t surface) const;

  /// Linear indices, within the region, of the grid nodes that the stencils touch, each once, ascending: the
  /// order of all grid arrays below. The span is valid until the next build().
  std::span<const std::int64_t> grid_nodes() const;
  /// The same list, for those who want to hold it longer: it does not change any more.
  std::shared_ptr<const std::vector<std::int64_t>> grid_node_list() const;

  /// u_m = sum_f delta(x_f - x_m) u_f (Eq. 2.3), and what the dipoles add.
  /// @param grid_velocity 3 x grid_nodes()
  /// @param node_velocity a span a surface, of all its nodes; those at home are overwritten, no others
  /// @throws std::invalid_argument if an array has another size than the stencils need
  void interpolate(std::span<const double> grid_velocity,
                   std::span<const std::span<double>> node_velocity) const;

  /// F_f = sum_m delta(x_f - x_m) F_m (Eq. 2.1), and what the dipoles add.
  /// @param node_force a span a surface, of all its nodes; looked at where they have stencils
  /// @param grid_force 3 x grid_nodes(), overwritten; of no use at nodes of the region outside of the part
  /// @throws std::invalid_argument if an array has another size than the stencils need
  void spread(std::span<const std::span<const double>> node_force, std::span<double> grid_force) const;

 private:
  friend class TangentialCorrection;  // which goes through the same stencils, with less on the way
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanktread::coupler
