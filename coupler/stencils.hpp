// The stencils of membrane nodes, and the list of grid nodes they touch. Internal to coupler/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {

/// Most points a kernel has along an axis.
inline constexpr int most_points = 4;

/// Weights of one membrane node along each axis, and the first grid node of its box, wrapped into the grid.
struct Stencil {
  std::array<std::array<double, most_points>, 3> weight;
  std::array<int, 3> first;
};

/// A run of grid nodes along x in the list of touched nodes. A run that reaches round the box goes on at
/// `wrapped`.
struct Run {
  std::int32_t start, wrapped;
};

/// Stencils of all surfaces, one after the other, and where their runs lie in the list of touched nodes.
class Stencils {
 public:
  Stencils(const Grid& grid, const Kernel& kernel, int n_threads);

  /// @throws StencilError; the old stencils stay
  void build(std::span<const std::span<const double>> surfaces);

  int n_points() const { return n_points_; }
  std::int64_t n_stencils() const { return static_cast<std::int64_t>(stencils_.size()); }
  const Stencil& stencil(std::int64_t node) const { return stencils_[node]; }
  /// Run of row (j, k) of a node's box, j along y, k along z.
  const Run& run(std::int64_t node, int j, int k) const {
    return runs_[(node * most_points + k) * most_points + j];
  }
  /// Points of a node's runs before they reach round the box along x.
  int points_before_wrap(std::int64_t node) const {
    return std::min(n_points_, grid_.nodes[0] - stencils_[node].first[0]);
  }
  /// Grid plane of the k-th layer of a node's box.
  int plane(std::int64_t node, int k) const { return wrapped(stencils_[node].first[2] + k, 2); }

  /// First node of each surface in the common numbering, and one past the last.
  const std::vector<std::int64_t>& surface_begin() const { return surface_begin_; }
  const std::vector<std::int64_t>& touched() const { return touched_; }

 private:
  int wrapped(int position, int axis) const {
    return position >= grid_.nodes[axis] ? position - grid_.nodes[axis] : position;
  }
  std::int64_t index(int x, int y, int z) const {
    return (std::int64_t{z} * grid_.nodes[1] + y) * grid_.nodes[0] + x;
  }
  /// Weights and place of one node. @return false if the stencil has no place in the grid
  bool place(const double* position, Stencil& stencil) const;
  [[noreturn]] void refuse(std::size_t surface, std::int64_t node, const double* position) const;
  void list_touched();

  Grid grid_;
  Kernel kernel_;
  int n_threads_, n_points_;
  std::vector<std::int64_t> surface_begin_;
  std::vector<Stencil> stencils_;
  std::vector<Run> runs_;
  std::vector<std::int64_t> touched_;                   ///< ascending
  std::vector<std::int32_t> place_of_;                  ///< of every grid node in touched_; -1: not touched
  std::vector<std::array<std::int32_t, 2>> row_reach_;  ///< of every row (y, z): first and last x touched
};

}  // namespace tanktread::coupler
