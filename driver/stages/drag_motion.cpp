#include "driver/stages/drag_motion.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "driver/program/errors.hpp"
#include "driver/system/phases.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

/// Of the velocities under an implicit viscosity; of their disturbances, whose growth is an estimate anyhow.
constexpr double velocity_tolerance = 1e-6, disturbance_tolerance = 1e-2;

/// Time in units of `law_step`: so an explicit viscous law, which knows strains step by step, has the rates
/// of the case.
Parameters with_law_step(Parameters parameters, double law_step) {
  for (auto& capsule : parameters.capsules) {
    if (!capsule.viscous || is_implicit(*capsule.viscous)) continue;
    capsule.viscous->shear_viscosity /= law_step;
    capsule.viscous->dilatational_viscosity /= law_step;
  }
  return parameters;
}

Parameters without_viscosity(Parameters parameters) {
  for (auto& capsule : parameters.capsules) capsule.viscous.reset();
  return parameters;
}

/// A disturbance in all directions and of all wavelengths, the same on every machine.
Eigen::Matrix3Xd first_disturbance(Eigen::Index n_nodes) {
  Eigen::Matrix3Xd disturbance(3, n_nodes);
  for (Eigen::Index k = 0; k < disturbance.size(); ++k) {
    // The golden ratio spreads its multiples evenly.
    const double turned = 0.6180339887498949 * static_cast<double>(k + 1);
    disturbance.data()[k] = turned - std::floor(turned) - 0.5;
  }
  return disturbance;
}

/// A membrane compares the normals of its elements with those that its history begins with.
void set_normals(CapsuleMembrane& membrane, const Eigen::Matrix3Xd& positions) {
  const auto& triangles = membrane.reference().triangles;
  auto state = membrane.state();
  Eigen::Map<Eigen::Matrix3Xd> normals(state.history.data(), 3, triangles.cols());
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d origin = positions.col(triangles(0, t));
    const Eigen::Vector3d along = positions.col(triangles(1, t)) - origin;
    const Eigen::Vector3d across = positions.col(triangles(2, t)) - origin;
    normals.col(t) = along.cross(across).normalized();
  }
  membrane.restore(state);
}

[[noreturn]] void refuse(std::size_t capsule, const membrane::NodeDrag::Solution& solution) {
  throw RunError(
      fmt::format("capsule {}: its velocities under the implicit viscosity are not found: after {} "
                  "iterations they are known to {:.3g} of their norm, {:g} is asked for; raise "
                  "coupler.implicit_iterations, or the drag (--drag)",
                  capsule, solution.n_iterations, solution.error, velocity_tolerance));
}

bool has_bending(const CapsuleMembrane& membrane) {
  const auto names = membrane.term_names();
  return std::ranges::find(names, "bending") != names.end();
}

/// @throws InvertedElement that names the capsule
void check_surface(membrane::SurfaceCheck& check, const Eigen::Matrix3Xd& positions, std::size_t capsule) {
  try {
    check.check(positions);
  } catch (const membrane::InvertedElement& error) {
    throw membrane::InvertedElement(fmt::format("capsule {}: {}", capsule, error.what()));
  }
}

double longest(const Eigen::Matrix3Xd& vectors) {
  return std::sqrt(vectors.colwise().squaredNorm().maxCoeff());
}

}  // namespace

DragMotion::DragMotion(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes,
                       double drag, double law_step)
    : most_iterations_(the_case.coupler.implicit_iterations),
      membranes_(make_membranes(the_case, with_law_step(parameters, law_step), shapes)),
      elastic_(make_membranes(the_case, without_viscosity(parameters), shapes)),
      springs_(membranes_.size()),
      growth_(membranes_.size(), 1.0) {
  for (std::size_t k = 0; k < membranes_.size(); ++k) {
    const auto& triangles = membranes_[k].reference().triangles;
    const auto& capsule = parameters.capsules[k];
    drag_.emplace_back(triangles, drag * parameters.kinematic_viscosity / capsule.radius);
    disturbance_.push_back(first_disturbance(membranes_[k].n_nodes()));
    if (capsule.viscous && !is_implicit(*capsule.viscous)) {
      springs_[k].emplace_back(triangles, membranes_[k].n_nodes(), capsule.viscous->shear_spring,
                               capsule.viscous->dilatational_spring, membrane::RatesAt::elements,
                               the_case.run.threads);
    }
  }
  for (const auto& membrane : membranes_) {
    checks_.emplace_back();
    if (has_bending(membrane)) checks_.back().emplace_back(membrane.reference().triangles);
  }
  velocity_ = zero_like(positions_of(membranes_));
}

membrane::NodeDrag::Solution DragMotion::solve(std::size_t k, const Eigen::Matrix3Xd& force, double tolerance,
                                               Eigen::Matrix3Xd& velocity) const {
  const auto* viscosity = membranes_[k].implicit_viscosity();
  if (viscosity != nullptr)
    return drag_[k].solve(force, viscosity->rates(), tolerance, most_iterations_, velocity);
  velocity = drag_[k].velocity(force);
  return {};
}

void DragMotion::start_at(const NodeVectors& positions) {
  for (auto* membranes : {&membranes_, &elastic_})
    for (std::size_t k = 0; k < positions.size(); ++k) set_normals((*membranes)[k], positions[k]);
}

void DragMotion::settle(const NodeVectors& positions, std::int64_t step) {
  const auto force = nodal_forces(membranes_, positions, velocity_, step);
  for (std::size_t k = 0; k < membranes_.size(); ++k)
    for (auto& check : checks_[k]) check_surface(check, positions[k], k);
  for (std::size_t k = 0; k < membranes_.size(); ++k) {
    drag_[k].set_positions(positions[k]);
    const auto solution = solve(k, force[k], velocity_tolerance, velocity_[k]);
    if (!(solution.error <= velocity_tolerance)) refuse(k, solution);
    if (auto* viscosity = membranes_[k].implicit_viscosity())
      viscosity->accept(viscosity->stress_of(velocity_[k]));
  }
}

NodeVectors DragMotion::moved(double dt) const {
  auto moves = velocity_;
  for (auto& move : moves) move *= dt;
  return move_nodes(positions_of(membranes_), moves);
}

NodeVectors DragMotion::force() const {
  auto forces = velocity_;
  for (std::size_t k = 0; k < forces.size(); ++k)
    forces[k] = velocity_[k] * drag_[k].coefficients().asDiagonal();
  return forces;
}

/// A step of the power iteration: the disturbance d becomes (zeta A + B^T B)^-1 K d, K the stiffness.
/// @return by how much longer each capsule's is, in the norm in which the iteration is symmetric
std::vector<double> DragMotion::grow_disturbance(const NodeVectors& positions, const NodeVectors& force,
                                                 std::int64_t step) {
  NodeVectors disturbed = positions;
  std::vector<double> scale;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    // Far below an edge, far above rounding.
    constexpr double of_edge = 1e-4;
    const auto& drag = drag_[k].coefficients();
    scale.push_back(of_edge * std::sqrt(drag.mean() / drag_[k].drag()) / longest(disturbance_[k]));
    disturbed[k] += scale[k] * disturbance_[k];
  }
  const auto changed = nodal_forces(elastic_, disturbed, velocity_, step);
  std::vector<double> growth;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    Eigen::Matrix3Xd change = (force[k] - changed[k]) / scale[k];
    for (auto& spring : springs_[k]) {
      Eigen::Matrix3Xd strain(3, spring.n_rates()), springy(3, change.cols());
      spring.set_positions(positions[k]);
      spring.multiply(disturbance_[k], strain);
      spring.multiply_transposed(strain, springy);
      change += springy;
    }
    const auto size = [&] {
      return std::sqrt(disturbance_[k].colwise().squaredNorm().dot(drag_[k].coefficients()));
    };
    const double before = size();
    disturbance_[k] *= growth_[k];  // where it is going to be, but for its direction
    solve(k, change, disturbance_tolerance, disturbance_[k]);
    growth.push_back(size() / before);
    disturbance_[k] /= longest(disturbance_[k]);
  }
  return growth;
}

double DragMotion::highest_rate(std::int64_t step) {
  const auto positions = positions_of(membranes_);
  // Between two trials elements may turn as far as they like.
  for (std::size_t k = 0; k < positions.size(); ++k) set_normals(elastic_[k], positions[k]);
  const auto force = nodal_forces(elastic_, positions, velocity_, step);
  const int n_iterations = has_grown_ ? 5 : 30;
  has_grown_ = true;
  for (int k = 0; k < n_iterations; ++k) growth_ = grow_disturbance(positions, force, step);
  return *std::ranges::max_element(growth_);
}

}  // namespace tanktread::driver
