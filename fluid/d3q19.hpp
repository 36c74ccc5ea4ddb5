// The D3Q19 lattice: velocities, weights, and which direction is opposite to which.
#pragma once

#include <array>

namespace tanktread::fluid::d3q19 {

/// Number of populations of a node: one at rest and nine opposite pairs.
inline constexpr int n_directions = 19;
inline constexpr int n_pairs = 9;

/// Lattice velocities c_i. Direction 0 rests; pair k (0 .. 8) is directions 2k+1 and 2k+2, opposite to each
/// other.
inline constexpr std::array<std::array<int, 3>, n_directions> velocity = {{
    {0, 0, 0},                //
    {1, 0, 0},  {-1, 0, 0},   // along the axes: pairs 0, 1, 2
    {0, 1, 0},  {0, -1, 0},   //
    {0, 0, 1},  {0, 0, -1},   //
    {1, 1, 0},  {-1, -1, 0},  // along the face diagonals: pairs 3 .. 8
    {1, -1, 0}, {-1, 1, 0},   //
    {1, 0, 1},  {-1, 0, -1},  //
    {1, 0, -1}, {-1, 0, 1},   //
    {0, 1, 1},  {0, -1, -1},  //
    {0, 1, -1}, {0, -1, 1},
}};

/// Weights w_i of the equilibrium (Qian, d'Humieres & Lallemand 1992).
inline constexpr double weight(int direction) {
  return direction == 0 ? 1.0 / 3.0 : (direction < 7 ? 1.0 / 18.0 : 1.0 / 36.0);
}

/// The direction with c_opposite = -c.
inline constexpr int opposite(int direction) {
  return direction == 0 ? 0 : (direction % 2 == 1 ? direction + 1 : direction - 1);
}

/// Lattice sound speed squared is 1/3.
inline constexpr double inverse_sound_speed_squared = 3.0;

}  // namespace tanktread::fluid::d3q19
