// The part of StencilBuilder that says why a membrane node has no stencil.
#include <sstream>

#include "coupler/stencils.hpp"

namespace tanktread::coupler {
namespace {

constexpr char axis_name[] = {'x', 'y', 'z'};

}  // namespace

void StencilBuilder::refuse(std::size_t surface, std::size_t node, const double* position) const {
  std::ostringstream message;
  message.precision(8);
  message << "coupler: surface " << surface << ", node " << node << " at (" << position[0] << ", "
          << position[1] << ", " << position[2] << "): ";
  for (int axis = 0; axis < 3; ++axis) {
    const double x = position[axis];
    const double length = grid_.nodes[axis];
    int first = 0;
    const auto lowest = axes_[axis].lowest(x);
    double weights[max_width];
    weights_of(kernel_, 1, &lowest.distance, weights);
    const Fit fit = axes_[axis].fit(x, lowest.node, first, weights, nullptr);
    if (fit == Fit::inside) continue;
    if (fit == Fit::not_finite) {
      message << axis_name[axis] << " is not finite";
    } else if (fit == Fit::too_far) {
      message << axis_name[axis] << " is more than " << farthest_coordinate
              << " grid steps from the origin, where a position no longer resolves the grid";
    } else {
      // The first node beyond a wall is half a grid step behind it.
      const bool low = x < 0.5 * length;
      message << "its distance from the wall at " << axis_name[axis] << " = " << (low ? 0.0 : length)
              << " is " << (low ? x : length - x) << " grid steps; kernel '" << kernel_.name
              << "' of half-width " << kernel_.half_width << " needs at least " << kernel_.half_width - 0.5;
    }
    throw StencilError(message.str(), precedence_of(StencilFault::position, surface, node));
  }
  throw std::logic_error("coupler: a node that fits was refused");
}

}  // namespace tanktread::coupler
