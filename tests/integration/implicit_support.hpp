// Small capsules with an implicit viscosity, and a look at a step of theirs from outside: the velocity that
// the nodes then have, and the one that they would have had without the viscous forces.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "driver/system/step.hpp"

namespace tanktread::driver {

/// One capsule. 450 steps a shear time.
inline constexpr const char* implicit_capsule = R"([flow]
box = [16, 14, 18]
wall_speed = 0.02
start = "developed"
[[capsule]]
radius = 4.0
position = [8.0, 7.0, 9.0]
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
viscous = { scheme = "implicit", boussinesq_shear = 5.0, boussinesq_dilatational = 3.0 }
)";

/// Three in one box, so near that each moves the nodes of the next: without a spring, elastic, with a spring.
inline constexpr const char* implicit_capsules = R"([flow]
box = [30, 14, 16]
wall_speed = 0.02
start = "developed"
[[capsule]]
radius = 3.5
position = [5.0, 7.0, 8.0]
mesh = { level = 1 }
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 5.0 } }
[[capsule]]
radius = 3.0
position = [13.0, 7.0, 8.5]
mesh = { level = 1 }
[[capsule]]
radius = 4.0
position = [22.0, 7.0, 7.8]
mesh = { level = 1 }
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 1.0, boussinesq_dilatational = 20.0, spring_stiffness = 200.0, strain_rates = "elements" } }
[membrane]
capillary_number = 0.3
)";

inline Case implicit_case(const std::vector<std::string>& assignments = {},
                          const char* text = implicit_capsule) {
  return parse_case(text, "implicit.toml", "/", assignments);
}

inline System make(const Case& the_case) {
  return make_system(the_case, parameters(the_case), membrane_shapes(the_case));
}

/// u_m that the next step begins with. It is before volumes are kept, which is a move of its own.
inline NodeVectors velocity_now(System& system) {
  const auto surfaces = surfaces_now(system.membranes, 1, {});
  auto velocity = interpolated_velocity(
      *system.coupler, grid_velocity(*system.fluid, system.coupler->grid_node_list()), surfaces.positions);
  const bool kept = std::exchange(system.corrections.keeps_volume, false);
  correct_velocity(*system.coupler, system.corrections, surfaces, system.node_force, velocity);
  system.corrections.keeps_volume = kept;
  return velocity;
}

inline double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

inline Eigen::Matrix3Xd rates(const membrane::ImplicitViscosity& viscosity,
                              const Eigen::Matrix3Xd& velocity) {
  Eigen::Matrix3Xd result(3, viscosity.rates().n_rates());
  viscosity.rates().multiply(velocity, result);
  return result;
}

/// No less than the largest |B u|/|u|: no eigenvalue of B^T B is above the largest sum of sizes of a column.
inline double largest_rates(const membrane::ImplicitViscosity& viscosity) {
  double largest = 0;
  Eigen::Matrix3Xd unit = Eigen::Matrix3Xd::Zero(3, viscosity.rates().n_nodes()), column = unit;
  for (auto& number : unit.reshaped()) {
    number = 1;
    viscosity.rates().multiply_transposed(rates(viscosity, unit), column);
    largest = std::max(largest, column.cwiseAbs().sum());
    number = 0;
  }
  return std::sqrt(largest);
}

/// A step of one system.
struct LookedAt {
  NodeVectors velocity;       ///< u_m(t+1)
  NodeVectors free_velocity;  ///< the same without viscous forces
  NodeVectors viscous_force;
  /// Over all membranes: (1 + theta) s - theta s(t) - B u_m(t+1), and B u0 + theta s(t).
  double residual = 0, right_side = 0;
  double rounding = 0;  ///< of the residual, for exact equations
};

/// One step. The velocity without viscous forces is that of another system, which takes the step from the
/// same state with elastic membranes only.
///
/// Rounding of the residual: what the fluid has then is what it foretold but for 1200 eps/3 in each component
/// (FluidFreeVelocity::tolerance; the largest population is near 1/3), and interpolated likewise, since
/// weights sum to 1. B makes of 3 n such components at most |B| sqrt(3 n) of one. The sums of spreading,
/// interpolation and correction, some hundred terms of size 0.02, are below that.
inline LookedAt advance_and_look(System& system, const Case& the_case) {
  auto plain_case = the_case;
  for (auto& capsule : plain_case.capsules) capsule.membrane.viscous = {};
  auto plain = make(plain_case);
  plain.fluid->restore(system.fluid->state());
  plain.node_force = system.node_force;
  plain.step = system.step;
  std::vector<std::optional<membrane::ImplicitViscosity>> before(system.membranes.size());
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    plain.membranes[k].set_positions(system.membranes[k].positions());
    const auto* viscosity = std::as_const(system.membranes[k]).implicit_viscosity();
    if (viscosity != nullptr) before[k] = *viscosity;
  }
  const auto surfaces = surfaces_of(plain.membranes);
  build_stencils(*plain.coupler, plain.corrections, surfaces.positions, surfaces.triangles);

  advance(plain);
  advance(system);

  LookedAt step{velocity_now(system), velocity_now(plain), system.node_force};
  double residual = 0, right_side = 0;
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    EXPECT_EQ(system.membranes[k].positions(), plain.membranes[k].positions());
    step.viscous_force[k] -= plain.node_force[k];
    if (!before[k]) continue;
    auto& viscosity = *before[k];
    viscosity.set_positions(system.membranes[k].positions());  // B of x(t+1), and s(t) carried there
    Eigen::Matrix3Xd memory = Eigen::Matrix3Xd::Zero(3, viscosity.rates().n_rates());
    viscosity.add_memory(memory);
    Eigen::Matrix3Xd left = -memory;
    viscosity.add_diagonal(std::as_const(system.membranes[k]).implicit_viscosity()->stress(), left);
    residual += (left - rates(viscosity, step.velocity[k])).squaredNorm();
    right_side += (rates(viscosity, step.free_velocity[k]) + memory).squaredNorm();
    step.rounding += largest_rates(viscosity) *
                     std::sqrt(3.0 * static_cast<double>(step.velocity[k].cols())) * 400 *
                     std::numeric_limits<double>::epsilon();
  }
  step.residual = std::sqrt(residual);
  step.right_side = std::sqrt(right_side);
  return step;
}

}  // namespace tanktread::driver
