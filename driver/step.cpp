#include "driver/step.hpp"

#include <fmt/format.h>

#include <chrono>

namespace tanktread::driver {
namespace {

/// Adds the time from its making to its end to a component's account.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

/// 1. Fluid velocity u(t) on the grid nodes that the stencils at x(t) touch.
std::vector<double> grid_velocity(System& system) {
  const Stopwatch watch(system.seconds.fluid);
  const auto nodes = system.coupler->grid_nodes();
  std::vector<double> velocity(3 * nodes.size());
  system.fluid->velocity(nodes, velocity);
  return velocity;
}

/// 2. Node velocity u_m(t), interpolated with the stencils at x(t).
void interpolate(System& system, const std::vector<double>& velocity) {
  const Stopwatch watch(system.seconds.coupler);
  std::vector<std::span<double>> targets;
  for (auto& target : system.node_velocity) targets.emplace_back(target.data(), target.size());
  system.coupler->interpolate(velocity, targets);
}

/// 3. Positions x(t+1) = x(t) + u_m(t) (Eq. 2.19).
void move_nodes(System& system) {
  const Stopwatch watch(system.seconds.membrane);
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    auto& membrane = system.membranes[k];
    const auto& velocity = system.node_velocity[k];
    for (Eigen::Index node = 0; node < velocity.cols(); ++node) {
      const double move = velocity.col(node).norm();
      if (move <= longest_move) continue;  // so that not a number does not pass
      const Eigen::Vector3d at = membrane.positions().col(node);
      throw RunError(
          fmt::format("step {}: node {} of capsule {} at ({:.6g}, {:.6g}, {:.6g}) would move by {:.6g} grid "
                      "steps; at most {} are allowed",
                      system.step + 1, node, k, at[0], at[1], at[2], move, longest_move));
    }
    membrane.set_positions(membrane.positions() + velocity);
  }
}

/// 4. Strain, stress and total nodal forces at x(t+1).
void nodal_forces(System& system) {
  const Stopwatch watch(system.seconds.membrane);
  for (std::size_t k = 0; k < system.membranes.size(); ++k) {
    system.node_force[k].setZero();
    system.membranes[k].add_forces(system.node_force[k]);
  }
}

/// 5. Stencils at x(t+1), and the grid force F(t+1) spread with them.
std::vector<double> spread(System& system) {
  const Stopwatch watch(system.seconds.coupler);
  build_stencils(system);
  std::vector<std::span<const double>> sources;
  for (const auto& force : system.node_force) sources.emplace_back(force.data(), force.size());
  std::vector<double> force(3 * system.coupler->grid_nodes().size());
  system.coupler->spread(sources, force);
  return force;
}

/// 6. The fluid streams to t+1 and collides under F(t+1).
void advance_fluid(System& system, const std::vector<double>& force) {
  const Stopwatch watch(system.seconds.fluid);
  system.fluid->clear_force();
  system.fluid->add_force(system.coupler->grid_nodes(), force);
  system.highest_speed = system.fluid->step();
}

}  // namespace

void advance(System& system) {
  try {
    const auto velocity = grid_velocity(system);
    interpolate(system, velocity);
    move_nodes(system);
    nodal_forces(system);
    const auto force = spread(system);
    advance_fluid(system, force);
    ++system.step;
  } catch (const fluid::Breakdown& error) {
    throw RunError(error.what());
  } catch (const membrane::InvertedElement& error) {
    throw RunError(fmt::format("step {}: {}", system.step + 1, error.what()));
  } catch (const coupler::StencilError& error) {
    throw RunError(fmt::format("step {}: {}", system.step + 1, error.what()));
  }
}

}  // namespace tanktread::driver
