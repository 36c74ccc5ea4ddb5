// The links that walls send populations back along, and the power that moving walls give there. Internal to
// fluid/.
#pragma once

#include <array>

#include "fluid/d3q19.hpp"
#include "fluid/fluid.hpp"

namespace tanktread::fluid {

/// Calls body(x, y, z) for each node beside a wall across `axis`, once, in the order of the nodes.
template <typename Body>
void for_each_wall_node(const GridShape& shape, int axis, Body&& body) {
  const std::array<int, 3> n = {shape.nx, shape.ny, shape.nz};
  // From one node of a row, column or file of nodes across the axis to the next: to the other wall at once.
  const auto next = [&](int position, int along) {
    return along == axis && position == 0 && n[along] > 1 ? n[along] - 1 : position + 1;
  };
  for (int z = 0; z < n[2]; z = next(z, 2))
    for (int y = 0; y < n[1]; y = next(y, 1))
      for (int x = 0; x < n[0]; x = next(x, 0)) body(x, y, z);
}

/// Power that the wall gives to the population that it sends back along direction i. The momentum that the
/// fluid takes there is c_i (f_in + f_out) (Ladd 1994), f_in = f_out + gain with gain = 6 w_i c_i.u_wall
/// (PopulationLattice::wall_gain), so that the wall's velocity along the link is c_i.u_wall = gain/(6 w_i).
/// What weights add to it cancels between the links of a node: a wall moves in its plane.
/// @param outgoing f_out less the weight, that goes to the wall
inline double power_of_link(int direction, double outgoing, double gain) {
  return gain / (6.0 * d3q19::weight(direction)) * (2.0 * outgoing + gain);
}

}  // namespace tanktread::fluid
