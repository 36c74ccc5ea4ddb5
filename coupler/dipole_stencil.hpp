// The way between a membrane node with a shear dipole and the grid nodes of its stencil.
#pragma once

#include <algorithm>
#include <cstdint>

#include "coupler/products.hpp"
#include "coupler/row.hpp"
#include "coupler/stencils.hpp"

namespace tanktread::coupler {

/// The stencil of one membrane node with the shear dipole of its surface (ShearDipole), for loops whose
/// length the compiler knows. All grid arrays: 3 numbers a node of Stencils::grid_nodes.
template <int width>
class DipoleStencil {
 public:
  DipoleStencil(const Stencils& stencils, std::size_t m, std::size_t surface, int nodes_along_x)
      : x_(&stencils.weights[3 * width * m]),
        slope_x_(&stencils.slopes[3 * width * m]),
        normal_(&stencils.normals[3 * m]),
        length_(stencils.dipole_length(surface)),
        run_(&stencils.run[width * width * m]) {
    if (stencils.across[m] < 0) return;
    across_run_ = &stencils.across_run[std::size_t{1} * width * width * stencils.across[m]];
    numbers_before_face_ = 3 * (nodes_along_x - stencils.first[m][0]);
  }

  /// What the node takes from a grid array, 3 numbers.
  __attribute__((always_inline)) void take(const double* grid, double* result) const {
    Row<row_length> sum, sum_y, sum_z;  // by the weights, by the slopes along y, along z
    for (int kz = 0; kz < width; ++kz) {
#pragma GCC unroll 8
      for (int ky = 0; ky < width; ++ky) {
        double pieces[row_length];
        const double* numbers = row_of(grid, kz * width + ky, pieces);
        sum.add(z_[kz] * y_[ky], numbers);
        sum_y.add(z_[kz] * slope_y_[ky], numbers);
        sum_z.add(slope_z_[kz] * y_[ky], numbers);
      }
    }
    double velocity[3], gradient[3][3];  // gradient[j]: of the velocity along axis j
    along_x(x_, sum, velocity);
    along_x(slope_x_, sum, gradient[0]);
    along_x(x_, sum_y, gradient[1]);
    along_x(x_, sum_z, gradient[2]);
    double shear[3];  // (G + G^T) n
    for (int c = 0; c < 3; ++c) {
      shear[c] = 0;
      for (int j = 0; j < 3; ++j) shear[c] += (gradient[j][c] + gradient[c][j]) * normal_[j];
    }
    const double along_normal = dot(shear, normal_);
    for (int c = 0; c < 3; ++c) result[c] = velocity[c] + length_ * (shear[c] - along_normal * normal_[c]);
  }

  /// Adds what the node gives to the grid nodes in the planes z of which has_plane(z).
  /// @param first_plane, n_planes of the stencil, and of the grid along z
  template <class HasPlane>
  __attribute__((always_inline)) void give(const double* force, int first_plane, int n_planes,
                                           const HasPlane& has_plane, double* grid) const {
    double dipole[3][3];  // dipole[j]: the vector that goes with the slope along axis j
    const double along_normal = dot(force, normal_);
    double tangential[3];
    for (int c = 0; c < 3; ++c) tangential[c] = force[c] - along_normal * normal_[c];
    for (int j = 0; j < 3; ++j) {
      for (int c = 0; c < 3; ++c)
        dipole[j][c] = length_ * (tangential[c] * normal_[j] + normal_[c] * tangential[j]);
    }
    const Row<row_length> by_weights(
        [&](int k) { return x_[k / 3] * force[k % 3] + slope_x_[k / 3] * dipole[0][k % 3]; });
    const Row<row_length> by_slope_y([&](int k) { return x_[k / 3] * dipole[1][k % 3]; });
    const Row<row_length> by_slope_z([&](int k) { return x_[k / 3] * dipole[2][k % 3]; });
    for (int kz = 0, z = first_plane; kz < width; ++kz) {
      if (has_plane(z)) {
        for (int ky = 0; ky < width; ++ky) {
          Row<row_length> row;
          row.add(z_[kz] * y_[ky], by_weights);
          row.add(z_[kz] * slope_y_[ky], by_slope_y);
          row.add(slope_z_[kz] * y_[ky], by_slope_z);
          add_to_row(grid, kz * width + ky, row);
        }
      }
      if (++z == n_planes) z = 0;
    }
  }

 private:
  static constexpr int row_length = 3 * width;  ///< numbers in a row: 3 components of `width` grid nodes

  template <class Number>
  static Number* at(Number* grid, std::int32_t grid_node) {
    return grid + 3 * std::int64_t{grid_node};
  }

  /// The numbers of a row one after the other; those across the face of x are put together in `pieces`.
  __attribute__((always_inline)) const double* row_of(const double* grid, int row, double* pieces) const {
    if (across_run_ == nullptr) return at(grid, run_[row]);
    std::copy_n(at(grid, run_[row]), numbers_before_face_, pieces);
    std::copy_n(at(grid, across_run_[row]), row_length - numbers_before_face_, pieces + numbers_before_face_);
    return pieces;
  }

  __attribute__((always_inline)) void add_to_row(double* grid, int row, const Row<row_length>& values) const {
    if (across_run_ == nullptr) return values.add_to(1.0, at(grid, run_[row]));
    double pieces[row_length];
    values.store_to(pieces);
    double *before = at(grid, run_[row]), *behind = at(grid, across_run_[row]);
    for (int k = 0; k < numbers_before_face_; ++k) before[k] += pieces[k];
    for (int k = numbers_before_face_; k < row_length; ++k) behind[k - numbers_before_face_] += pieces[k];
  }

  __attribute__((always_inline)) static void along_x(const double* weights, const Row<row_length>& row,
                                                     double* result) {
    double numbers[row_length];
    row.store_to(numbers);
    for (int component = 0; component < 3; ++component) {
      double total = 0.0;
#pragma GCC unroll 8
      for (int kx = 0; kx < width; ++kx) total += weights[kx] * numbers[3 * kx + component];
      result[component] = total;
    }
  }

  const double *x_, *y_ = x_ + width, *z_ = y_ + width;  ///< weights along each axis
  const double *slope_x_, *slope_y_ = slope_x_ + width, *slope_z_ = slope_y_ + width;
  const double* normal_;
  double length_;                             ///< of the dipole
  const std::int32_t* run_;                   ///< number of the first grid node of each row
  const std::int32_t* across_run_ = nullptr;  ///< that of the part behind the periodic face of x
  int numbers_before_face_ = row_length;      ///< numbers of a row before that face
};

}  // namespace tanktread::coupler
