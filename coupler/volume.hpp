// The volume that a closed surface encloses, kept while its nodes move.
#pragma once

#include <span>

namespace tanktread::coupler {

/// Changes the velocities of the nodes by as little as possible (in the sum of squares) so that the surface
/// encloses the same volume after they moved by them, for one step:
///
///     v_m -= [V(x + v) - V(x)]/sum_n A_n^2 A_m,    A_m = dV/dx_m = 1/6 sum x_b x x_c  (triangles m, b, c
///     around)
///
/// twice, with the same A: what is left is the change times the square of the strain of a step, nothing
/// beside rounding. Nodes that are carried by an interpolated velocity, which is not quite without
/// divergence, and by explicit steps gain or lose a little volume for ever (docs/kernels.md, "Volume"). A
/// velocity that is not finite leaves all as they are.
/// @param positions, velocity 3 numbers a node, grid steps (a step)
/// @param triangles 3 node numbers a triangle, of a closed surface
/// @throws std::invalid_argument if the sizes do not fit, or a triangle names a node that does not exist
void keep_volume(std::span<const double> positions, std::span<const int> triangles,
                 std::span<double> velocity);

}  // namespace tanktread::coupler
