// The way between one membrane node and the grid nodes of its stencil.
#pragma once

#include <algorithm>
#include <cstdint>

#include "coupler/products.hpp"
#include "coupler/row.hpp"
#include "coupler/stencils.hpp"

namespace tanktread::coupler {

/// The stencil of one membrane node, for loops whose length the compiler knows. All grid arrays: 3 numbers a
/// node of Stencils::grid_nodes.
template <int width>
class NodeStencil {
 public:
  NodeStencil(const Stencils& stencils, std::size_t m, int nodes_along_x)
      : x_(&stencils.weights[3 * width * m]),
        y_(x_ + width),
        z_(y_ + width),
        run_(&stencils.run[width * width * m]) {
    if (stencils.across[m] < 0) return;
    across_run_ = &stencils.across_run[std::size_t{1} * width * width * stencils.across[m]];
    length_before_face_ = 3 * (nodes_along_x - stencils.first[m][0]);
  }

  /// What the node takes from a grid array: sum_f delta(x_f - x_m) u_f, 3 numbers.
  __attribute__((always_inline)) void take(const double* grid, double* result) const {
    if (across_run_ != nullptr) return take_across(grid, result);
    Row<length> sum;
    for_rows([&](int row, double weight) { sum.add(weight, at(grid, run_[row])); });
    add_along_x(sum, result);
  }

  /// Adds delta(x_f - x_m) F to the grid nodes in the planes z of which has_plane(z).
  /// @param first_plane, n_planes of the stencil, and of the grid along z
  template <class HasPlane>
  __attribute__((always_inline)) void give(const double* force, int first_plane, int n_planes,
                                           const HasPlane& has_plane, double* grid) const {
    if (across_run_ != nullptr) return give_across(force, first_plane, n_planes, has_plane, grid);
    const Row<length> along_x([&](int k) { return x_[k / 3] * force[k % 3]; });
    for_rows_in_planes(first_plane, n_planes, has_plane,
                       [&](int row, double weight) { along_x.add_to(weight, at(grid, run_[row])); });
  }

 private:
  static constexpr int length = 3 * width;  ///< numbers in a row: 3 components of `width` grid nodes

  template <class Number>
  static Number* at(Number* grid, std::int32_t grid_node) {
    return grid + 3 * std::int64_t{grid_node};
  }

  /// Calls visit(row, weight) for the rows in their order.
  template <class Visit>
  __attribute__((always_inline)) void for_rows(const Visit& visit) const {
#pragma GCC unroll 8
    for (int kz = 0; kz < width; ++kz) {
#pragma GCC unroll 8
      for (int ky = 0; ky < width; ++ky) visit(kz * width + ky, z_[kz] * y_[ky]);
    }
  }

  /// The same for the rows in planes z of which has_plane(z).
  template <class HasPlane, class Visit>
  __attribute__((always_inline)) void for_rows_in_planes(int first_plane, int n_planes,
                                                         const HasPlane& has_plane,
                                                         const Visit& visit) const {
    for (int kz = 0, z = first_plane; kz < width; ++kz) {
      if (has_plane(z)) {
#pragma GCC unroll 8
        for (int ky = 0; ky < width; ++ky) visit(kz * width + ky, z_[kz] * y_[ky]);
      }
      if (++z == n_planes) z = 0;
    }
  }

  __attribute__((always_inline)) void add_along_x(const Row<length>& sum, double* result) const {
    double sums[length];
    sum.store_to(sums);
#pragma GCC unroll 3
    for (int component = 0; component < 3; ++component) {
      double total = 0.0;
#pragma GCC unroll 8
      for (int kx = 0; kx < width; ++kx) total = multiply_add(x_[kx], sums[3 * kx + component], total);
      result[component] = total;
    }
  }

  // Across the face of x, apart from the loops above: there the compiler shall have all registers.
  __attribute__((noinline)) void take_across(const double* grid, double* result) const {
    Row<length> sum;
    for_rows([&](int row, double weight) {
      double pieces[length];
      std::copy_n(at(grid, run_[row]), length_before_face_, pieces);
      std::copy_n(at(grid, across_run_[row]), length - length_before_face_, pieces + length_before_face_);
      sum.add(weight, pieces);
    });
    add_along_x(sum, result);
  }

  template <class HasPlane>
  __attribute__((noinline)) void give_across(const double* force, int first_plane, int n_planes,
                                             const HasPlane& has_plane, double* grid) const {
    double along_x[length];
    for (int k = 0; k < length; ++k) along_x[k] = x_[k / 3] * force[k % 3];
    for_rows_in_planes(first_plane, n_planes, has_plane, [&](int row, double weight) {
      double *before = at(grid, run_[row]), *behind = at(grid, across_run_[row]);
      for (int k = 0; k < length_before_face_; ++k) before[k] += weight * along_x[k];
      for (int k = length_before_face_; k < length; ++k)
        behind[k - length_before_face_] += weight * along_x[k];
    });
  }

  const double *x_, *y_, *z_;                 ///< weights along each axis
  const std::int32_t* run_;                   ///< number of the first grid node of each row
  const std::int32_t* across_run_ = nullptr;  ///< that of the part behind the periodic face of x
  int length_before_face_ = length;           ///< numbers of a row before that face
};

}  // namespace tanktread::coupler
