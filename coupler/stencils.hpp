// The stencils of all surfaces at one instant, and how they are built.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "coupler/axis_stencil.hpp"
#include "coupler/coupler.hpp"
#include "coupler/grid_marks.hpp"
#include "coupler/node_selection.hpp"

namespace tanktread::coupler {

/// A share of the work on the grid: the planes z = first_plane .. last_plane - 1, to whose nodes it alone
/// writes.
struct GridShare {
  int first_plane = 0, last_plane = 0;             ///< the last is the first of the next share
  std::size_t first_node = 0, last_node = 0;       ///< its part of Stencils::share_nodes
  std::int64_t first_number = 0, last_number = 0;  ///< its part of Stencils::grid_nodes

  bool has_plane(int z) const { return first_plane <= z && z < last_plane; }
};

/// Stencil m (counted through all surfaces), of one membrane node, is the product of three stencils of
/// `width` grid nodes, one an axis. In each of its width x width rows along x it touches a run of neighbours,
/// whose numbers in grid_nodes are consecutive: one number a row says where they are. A run that goes on
/// across the periodic face of x has a second part, which begins at x = 0.
struct Stencils {
  int width = 0;
  NodeSelection nodes;                    ///< whose they are
  std::vector<double> weights;            ///< [m][axis][width]
  std::vector<ShearDipole> dipoles;       ///< a surface, or none; their normals are gone, but for:
  std::vector<double> normals;            ///< [m][3], of surfaces with a dipole
  std::vector<double> slopes;             ///< [m][axis][width], d weight/dx_m, likewise
  std::vector<std::array<int, 3>> first;  ///< [m] lowest grid index along each axis, within the region
  std::vector<std::int32_t> run;          ///< [m][z][y] number of the first grid node of each row
  std::vector<std::int32_t> across;       ///< [m] its place in across_run, in stencils; -1: not across x
  std::vector<std::int32_t> across_run;   ///< [place][z][y] number of the grid node at x = 0 of each row
  /// Linear indices, ascending; shared with those who hold it beyond this instant.
  std::shared_ptr<std::vector<std::int64_t>> grid_nodes = std::make_shared<std::vector<std::int64_t>>();
  std::vector<GridShare> shares;  ///< one after the other, all planes of the region
  /// The stencils that touch the planes of the first share, ascending, then those of the second ...
  std::vector<std::size_t> share_nodes;

  std::size_t n_surfaces() const { return nodes.n_nodes_of_surface.size(); }
  std::size_t n_nodes() const { return nodes.n_stencils(); }
  /// d of the surface's shear dipole.
  double dipole_length(std::size_t surface) const { return dipoles.empty() ? 0 : dipoles[surface].length; }
};

/// What a StencilError says, in the order in which they are looked for.
enum class StencilFault { normal, position };

/// StencilError::precedence.
inline std::uint64_t precedence_of(StencilFault fault, std::size_t surface, std::size_t node) {
  return std::uint64_t{fault == StencilFault::position} << 63 | std::uint64_t{surface} << 32 |
         std::uint64_t{node};
}

/// Builds Stencils for one part of a grid and one kernel.
class StencilBuilder {
 public:
  /// @param n_shares the work is cut into this many shares, each done by one thread
  StencilBuilder(const Grid& grid, const GridPart& part, const Kernel& kernel, int n_shares);

  const Kernel& kernel() const { return kernel_; }
  const GridPart& region() const { return region_; }
  /// The region as a grid of its own, whose nodes the stencils name.
  const Grid& grid_of_stencils() const { return region_grid_; }
  StencilBuilder(const StencilBuilder&) = delete;
  StencilBuilder& operator=(const StencilBuilder&) = delete;

  /// Fills `stencils` anew; its memory is used again. After a throw it holds nothing of use.
  /// @throws StencilError, std::invalid_argument, std::length_error: as Coupler::build()
  void build(std::span<const std::span<const double>> surfaces, std::span<const ShearDipole> dipoles,
             Stencils& stencils);

 private:
  /// What a share of the membrane nodes counts.
  struct Counts {
    std::vector<std::size_t> of_first_plane;  ///< nodes whose stencil begins in each plane
    std::vector<std::size_t> of_share;        ///< nodes that touch each share of the grid
    std::int32_t across = 0;                  ///< stencils across the periodic face of x
    std::size_t first_refused = 0;            ///< the first node without a stencil; that after the last: none
  };

  void select(std::span<const std::span<const double>> surfaces, Stencils& stencils);
  void weigh(std::span<const std::span<const double>> surfaces, Stencils& stencils);
  void weigh_nodes(const double* positions, std::size_t begin, std::size_t end, bool with_slopes,
                   Stencils& stencils, Counts& counts) const;
  void check_dipoles(std::span<const ShearDipole> dipoles, const Stencils& stencils) const;
  void take_dipoles(std::span<const ShearDipole> dipoles, Stencils& stencils) const;
  void cut_grid(Stencils& stencils);
  void list_share_nodes(Stencils& stencils);
  void mark(Stencils& stencils);
  template <int width>
  void mark_share(const Stencils& stencils, const GridShare& share);
  void number(Stencils& stencils);
  template <int width>
  void find_runs(int part, Stencils& stencils) const;
  GridMarks::Rows rows_of(const GridShare& share) const;
  [[noreturn]] void refuse(std::size_t surface, std::size_t node, const double* position) const;

  Grid grid_;
  Kernel kernel_;
  int width_, n_shares_;
  GridPart region_;
  Grid region_grid_;
  NodeSelector selector_;
  std::array<AxisStencil, 3> axes_;
  GridMarks marks_;
  std::vector<int> share_of_plane_;
  std::vector<Counts> counts_;
};

}  // namespace tanktread::coupler
