// A twisting sphere of triangles: strain rate and viscous stress of its elements against the exact ones.
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "membrane/viscous_parameters.hpp"

namespace tanktread::driver {

/// How the nodes get to their positions (Sect. 3.4.2).
enum class TwistApproach {
  surface,  ///< "twisting surface": by the exact motion
  flow,  ///< "swirling flow": the exact velocity on the grid is interpolated, and moves them by Euler steps
};

/// Sect. 3.4.2 of the thesis, with its values as defaults. Lengths in grid steps, times in time steps.
struct TwistStudy {
  TwistApproach approach = TwistApproach::surface;
  std::vector<std::string> schemes = {"fd", "int1", "int2"};  ///< of membrane::maxwell_schemes()
  int level = 4;                                              ///< 20 * 4^level triangles
  double radius = 20;                                         ///< R
  double amplitude = std::numbers::pi / 18;                   ///< A0, radians
  double period = 1e4;                                        ///< T0
  /// mu_s of Eq. 3.38, where the stress is mu_s times the strain rate: 2 mu_s of the law, whose stress is
  /// 2 mu_s times it (Eq. 2.9).
  double viscosity = 10;
  double stiffness = 0.1;  ///< k_s'; the relaxation time is mu_s/k_s'
  /// Dilatational viscosity over mu_s, with the relaxation time of the shear part. 1: the stress is mu_s
  /// times the strain rate in every component. The exact motion has no dilatation, that of the triangles has.
  double dilatational_ratio = 1;
  std::array<double, 3> axis = {0, 0, 1};    ///< the mesh of membrane::icosphere is turned about this axis
  double angle_deg = 0;                      ///< by this angle
  std::string kernel = "cosine4";            ///< of coupler::kernels(); in the approach `flow`
  int box = 64;                              ///< grid nodes along each axis, at 1/2, 3/2 ...
  std::array<double, 3> offset = {0, 0, 0};  ///< of the centre from the middle of the box
  membrane::StressMeasure measure = membrane::StressMeasure::rate_of_deformation;
  std::vector<double> times = {0.25, 0.75};  ///< t/T0 of the readings, taken at the nearest step

  static constexpr double most_steps = 1e9;  ///< up to the last reading
};

/// Root mean squares over all elements of computed less exact (Eq. 3.41), at the element's present centroid
/// in the frame e_theta, e_phi there: the components theta-phi, theta-theta, phi-phi.
struct TwistErrors {
  double time;                        ///< t/T0 of the step at which it was read
  std::string scheme;                 ///< of the stress; the strain rate is the same for all
  std::array<double, 3> strain_rate;  ///< over A0 omega/4; the backward difference over one time step
  std::array<double, 3> stress;       ///< over mu_s A0 omega/4
};

/// Runs the motion up to the last reading.
/// @return the errors of each scheme at each of the times
/// @throws std::invalid_argument naming the parameter that is out of range
std::vector<TwistErrors> twist_errors(const TwistStudy& study);

/// The table of `tanktread study twisting-sphere`, as CSV: a row a study, scheme, time and component.
/// @throws std::invalid_argument as twist_errors()
std::string twist_table(const std::vector<TwistStudy>& studies);

}  // namespace tanktread::driver
