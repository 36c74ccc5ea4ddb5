// A discrete delta as a table, for the theory of what it makes of a capsule
// (post/tanktread_post/kernel_theory.py).
#pragma once

#include <string>

namespace tanktread::driver {

/// phi at equal distances.
struct KernelStudy {
  static constexpr int most_points = 65536;
  std::string kernel = "cosine4";  ///< of coupler::kernels()
  int points = 256;                ///< distances a grid step; even, so that the kinks of a kernel lie on them
};

/// The first line of the table.
inline constexpr const char* kernel_table_header = "kernel,distance,phi\n";

/// The table of `tanktread study kernel`, as CSV: kernel, distance (grid steps, from 0 to the half-width),
/// phi.
/// @throws std::invalid_argument for a kernel that is not known, or points that are not even, below 2 or
/// above 65536
std::string kernel_table(const KernelStudy& study);

}  // namespace tanktread::driver
