// The stencil along one axis: which grid indices a coordinate touches, and with what weights.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "coupler/coupler.hpp"
#include "coupler/grid_region.hpp"

namespace tanktread::coupler {

/// Widest kernel that has a compiled stencil loop, in grid nodes.
inline constexpr int max_width = 6;

/// Grid steps from the origin beyond which a coordinate is refused: a double there resolves 2.4e-7 of a grid
/// step, and weights would lose that much.
inline constexpr double farthest_coordinate = 1073741824.0;  // 2^30

/// Number of grid nodes that a kernel touches along an axis.
inline int width_of(const Kernel& kernel) {
  return static_cast<int>(std::ceil(2.0 * kernel.half_width));
}

/// Calls function.operator()<width>(), for a width known at run time only.
template <class Function>
void for_width(int width, const Function& function) {
  switch (width) {
    case 2:
      return function.template operator()<2>();
    case 3:
      return function.template operator()<3>();
    case 4:
      return function.template operator()<4>();
    case 5:
      return function.template operator()<5>();
    case 6:
      return function.template operator()<6>();
    default:
      throw std::logic_error("coupler: no stencil loop of width " + std::to_string(width));
  }
  static_assert(max_width == 6);
}

/// The weights of n coordinates, `width_of(kernel)` each, from the distances of their lowest nodes on.
inline void weights_of(const Kernel& kernel, int n, const double* first_distances, double* weights) {
  if (kernel.weights) return kernel.weights(n, first_distances, weights);
  for (int k = 0, width = width_of(kernel); k < n; ++k) {
    for (int point = 0; point < width; ++point) *weights++ = kernel.function(first_distances[k] + point);
  }
}

/// Likewise the derivatives of the weights by the coordinate, - d phi/dr.
inline void slopes_of(const Kernel& kernel, int n, const double* first_distances, double* slopes) {
  kernel.slopes(n, first_distances, slopes);
  const int n_slopes = n * width_of(kernel);
  for (int k = 0; k < n_slopes; ++k) slopes[k] = -slopes[k];
}

/// The lowest grid node within a kernel's reach of a position, any whole number.
inline double lowest_node(double position, double half_width) {
  // The lowest node whose distance is less than the half-width. The highest then is at most at the
  // half-width, where the kernel vanishes.
  return std::floor(position - 0.5 - half_width) + 1.0;
}

/// What became of a coordinate.
enum class Fit { inside, beyond_wall, not_finite, too_far };

/// The grid as seen along one axis, its nodes counted from that where a region of it begins. The kernel is
/// borrowed and must outlive this.
class AxisStencil {
 public:
  AxisStencil(const Grid& grid, const GridPart& region, int axis, const Kernel& kernel)
      : nodes_(grid.nodes[axis]),
        periodic_(grid.periodic[axis]),
        begin_(region.begin[axis]),
        width_(width_of(kernel)),
        kernel_(kernel) {}

  /// The lowest grid node within the kernel's reach, and its distance from the position.
  struct Lowest {
    double node, distance;
  };
  Lowest lowest(double position) const {
    const double node = lowest_node(position, kernel_.half_width);
    return {node, node - (position - 0.5)};
  }

  /// Finds the `width` grid nodes first, first + 1, ... (modulo the period) within the kernel's reach.
  /// @param lowest   the grid node of lowest(position)
  /// @param first    the lowest of them, counted from the region's first; if the region is the grid,
  ///                 0 <= first < nodes; without a period first + width <= nodes as well
  /// @param weights  `width` numbers, phi(node - position) from the lowest node on; perhaps shifted
  /// @param slopes   of these, anew where they are shifted; or null
  /// @return anything but `inside`: first, weights and slopes are of no use
  Fit fit(double position, double lowest, int& first, double* weights, double* slopes) const {
    if (!std::isfinite(position)) return Fit::not_finite;
    if (std::abs(position) > farthest_coordinate) return Fit::too_far;
    std::int64_t index = static_cast<std::int64_t>(lowest);
    if (periodic_) {
      first = wrapped(index - begin_, nodes_);
      return Fit::inside;
    }
    // A node beyond the wall is harmless where its weight is zero (a kernel just at the end of its reach):
    // the window then moves inside by one node, whose weight is zero as well.
    if (index < 0 && weights[0] == 0.0) {
      std::copy(weights + 1, weights + width_, weights);
      weights[width_ - 1] = 0.0;
      ++index;
      if (slopes != nullptr) slopes_from(lowest + 1.0, position, slopes);
    } else if (index + width_ > nodes_ && weights[width_ - 1] == 0.0) {
      std::copy_backward(weights, weights + width_ - 1, weights + width_);
      weights[0] = 0.0;
      --index;
      if (slopes != nullptr) slopes_from(lowest - 1.0, position, slopes);
    }
    first = static_cast<int>(index - begin_);
    return index >= 0 && index + width_ <= nodes_ ? Fit::inside : Fit::beyond_wall;
  }

 private:
  /// Anew, for a slope beyond the wall need not be zero where the weight is (linear2 on a grid node).
  void slopes_from(double node, double position, double* slopes) const {
    const double distance = node - (position - 0.5);
    slopes_of(kernel_, 1, &distance, slopes);
  }

  int nodes_;
  bool periodic_;
  int begin_;  ///< of the region
  int width_;
  const Kernel& kernel_;
};

}  // namespace tanktread::coupler
