// The noise that a discrete delta leaves in a strain rate: a point that moves with a known flow, whose
// velocity is interpolated from grid nodes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tanktread::driver {

/// Appendix A of the thesis: the corner flow of the stream function psi = 3 x^2 y - y^3 (Eq. 2.38) in the
/// unit square, and a point on the streamline psi. Lengths and times in the units of that flow.
struct NoiseStudy {
  std::string kernel = "cosine4";  ///< of coupler::kernels(); the delta is the product over x and y
  int nodes = 100;                 ///< grid steps along a side: nodes sit at k/nodes
  double stream_function = 0.2;    ///< psi of the streamline
  double start_height = 0.98;      ///< y of the first position
  double time_step = 0.0015;
  int n_positions = 500;
  double velocity_error = 0;  ///< grid velocities are multiplied by 1 + this

  /// Of nodes: far below them a difference of positions is lost in rounding. Of positions: all are kept.
  static constexpr int most_nodes = 1'000'000, most_positions = 10'000'000;
};

/// u = d psi/dy, v = -d psi/dx.
Eigen::Vector2d corner_flow(const Eigen::Vector2d& position);

/// Positions along the streamline, a column each: y goes on by the explicit Euler method, x follows from psi.
/// Of all ways to integrate, this one gives the coordinates that Appendix A quotes, to the digit.
/// @throws std::invalid_argument naming the parameter that is out of range
Eigen::Matrix2Xd streamline_positions(const NoiseStudy& study);

/// Velocity at a position, interpolated from the grid nodes (Eq. 2.40).
/// @throws std::invalid_argument if the kernel is not known
Eigen::Vector2d interpolated_velocity(const NoiseStudy& study, const Eigen::Vector2d& position);

/// Relative L2 error of the strain rate (Eqs. 2.41-2.42): the backward difference over N steps, at every step
/// from the Nth on, with the interpolated velocity against the same difference with the exact one.
/// @param interval N, 1 to n_positions - 1
/// @throws std::invalid_argument as streamline_positions(), or for an interval out of range
double strain_rate_error(const NoiseStudy& study, int interval);

/// The table of `tanktread study strain-rate-noise`, as CSV: a row an interval.
/// @throws std::invalid_argument as strain_rate_error()
std::string noise_table(const NoiseStudy& study, const std::vector<int>& intervals);

}  // namespace tanktread::driver
