// The stencils of all surfaces at one instant, and how they are built.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coupler/axis_stencil.hpp"
#include "coupler/coupler.hpp"
#include "coupler/grid_marks.hpp"

namespace tanktread::coupler {

/// The stencil of membrane node m (counted through all surfaces) is the product of three stencils of `width`
/// grid nodes, one an axis. In each of its width x width rows along x it touches a run of neighbours, whose
/// numbers in grid_nodes are consecutive: one number a row says where they are. A run that goes on across the
/// periodic face of x has a second part, which begins at x = 0.
struct Stencils {
  int width = 0;
  std::vector<std::size_t> first_node = {0};  ///< membrane nodes before each surface; at the end, of all
  std::vector<double> weights;                ///< [m][axis][width]
  std::vector<std::array<int, 3>> first;      ///< [m] lowest grid index along each axis, within the grid
  std::vector<std::int32_t> run;              ///< [m][z][y] number of the first grid node of each row
  std::vector<std::int32_t> across;           ///< [m] its place in across_run, in stencils; -1: not across x
  std::vector<std::int32_t> across_run;       ///< [place][z][y] number of the grid node at x = 0 of each row
  std::vector<std::int64_t> grid_nodes;       ///< linear indices, ascending

  std::size_t n_surfaces() const { return first_node.size() - 1; }
  std::size_t n_nodes() const { return first_node.back(); }
};

/// Builds Stencils for one grid and kernel.
class StencilBuilder {
 public:
  /// @param shares the work is cut into this many shares, each done by one thread
  StencilBuilder(const Grid& grid, const Kernel& kernel, int shares);

  const Kernel& kernel() const { return kernel_; }
  StencilBuilder(const StencilBuilder&) = delete;
  StencilBuilder& operator=(const StencilBuilder&) = delete;

  /// Fills `stencils` anew; its memory is used again. After a throw it holds nothing of use.
  /// @throws StencilError, std::invalid_argument, std::length_error: as Coupler::build()
  void build(std::span<const std::span<const double>> surfaces, Stencils& stencils);

  /// The share that owns the grid plane z: the only one that writes to it.
  int share_of_plane(int z) const { return share_of_plane_[z]; }

 private:
  void resize(std::span<const std::span<const double>> surfaces, Stencils& stencils) const;
  void weigh(std::span<const std::span<const double>> surfaces, Stencils& stencils) const;
  void mark(const Stencils& stencils);
  void find_runs(Stencils& stencils) const;
  void list_numbers(const std::array<int, 3>& first, int x, std::int32_t* numbers) const;
  /// Calls visit(row) for the rows of a stencil in the plane z, in the order of its y.
  template <class Visit>
  void visit_rows(const std::array<int, 3>& first, int z, const Visit& visit) const;
  void place_across(Stencils& stencils) const;
  [[noreturn]] void refuse(std::size_t surface, std::size_t node, const double* position) const;

  Grid grid_;
  Kernel kernel_;
  int width_, shares_;
  std::array<AxisStencil, 3> axes_;
  GridMarks marks_;
  std::vector<int> share_of_plane_;
};

}  // namespace tanktread::coupler
