#include "driver/study/layers_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "driver/program/errors.hpp"
#include "driver/study/study_check.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::driver {
namespace {

constexpr double speed = 0.01;
/// Nodes along x and y, the fewest that the solver takes: the flow is the same along both.
constexpr int nx = 3, ny = 1;

void require_valid(const LayersStudy& study) {
  require_positive("viscosity ratio", study.viscosity_ratio);
  require_positive("magic parameter", study.magic_parameter);
  require(study.height >= 1 && study.height <= LayersStudy::most_height,
          fmt::format("height is {}, must be 1 to {}", study.height, LayersStudy::most_height));
  require(study.n_places >= 1 && study.n_places <= LayersStudy::most_places,
          fmt::format("places is {}, must be 1 to {}", study.n_places, LayersStudy::most_places));
  require(std::isfinite(study.relaxation_time) && study.relaxation_time > 0.5,
          fmt::format("relaxation time is {}, must be above 0.5", study.relaxation_time));
  require(study.steadiness >= LayersStudy::least_steadiness && study.steadiness < 1,
          fmt::format("steadiness is {}, must be from {} to below 1", study.steadiness,
                      LayersStudy::least_steadiness));
  require(study.sheet > 0 && study.sheet < 1,
          fmt::format("sheet is {}, must be above 0 and below 1", study.sheet));
}

struct Viscosities {
  double below, above;
};

Viscosities viscosities_of(const LayersStudy& study) {
  const double lower = (study.relaxation_time - 0.5) / 3, ratio = study.viscosity_ratio;
  return ratio >= 1 ? Viscosities{ratio * lower, lower} : Viscosities{lower, lower / ratio};
}

TwoLayers layers_with_force(const LayersStudy& study, double sheet_height, double force) {
  const auto [below, above] = viscosities_of(study);
  return {.height = static_cast<double>(study.height),
          .sheet = sheet_height,
          .viscosity_below = below,
          .viscosity_above = above,
          .force = force};
}

/// The number of steps in which any departure from the steady flow falls by 1/e at least: that of the slowest
/// mode if all were the less viscous liquid, and what collisions take. Their factor is 1 - 1/tau, tau = 1/2 +
/// a, which is below 1/e after a + 1/(4 a) steps; twice as many, for where flow and collisions are alike slow
/// they swing, and that decays half as fast.
int decay_steps(const LayersStudy& study) {
  const auto [below, above] = viscosities_of(study);
  double of_collisions = 0;
  for (const double even : {3 * below, 3 * above}) {
    for (const double a : {even, study.magic_parameter / even})
      of_collisions = std::max(of_collisions, 2 * (a + 1 / (4 * a)));
  }
  const double of_flow =
      study.height * study.height / (std::numbers::pi * std::numbers::pi * std::min(below, above));
  const double steps = std::ceil(of_flow + of_collisions);
  require(steps <= LayersStudy::most_steps,
          fmt::format("what differs from the steady flow falls by 1/e in {:.3g} steps, of which {:g} are the "
                      "most; take a relaxation time and a viscosity ratio nearer to 1, or a lower height",
                      steps, LayersStudy::most_steps));
  return static_cast<int>(steps);
}

std::unique_ptr<fluid::Fluid> fluid_at_rest(const LayersStudy& study, double sheet_height) {
  const auto layers = exact_layers(study, sheet_height);
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {nx, ny, study.height};
  settings.walls = fluid::WallPair{2, {0, 0, 0}, {layers.wall_velocity, 0, 0}};
  settings.body_force = {layers.force, 0, 0};
  settings.relaxation_time = study.relaxation_time;
  settings.magic_parameter = study.magic_parameter;
  settings.inertia = false;
  settings.threads = 1;
  auto fluid = fluid::make_lattice_boltzmann(settings);
  std::vector<double> viscosity;
  for (const double of_level : node_viscosities(study, sheet_height))
    viscosity.insert(viscosity.end(), nx * ny, of_level);
  fluid->set_viscosity(viscosity);
  return fluid;
}

/// The velocity along x of one node of each level.
std::vector<double> velocities_along_x(const fluid::Fluid& fluid) {
  const auto shape = fluid.shape();
  std::vector<std::int64_t> nodes;
  for (int z = 0; z < shape.nz; ++z) nodes.push_back(shape.index(0, 0, z));
  std::vector<double> velocity(3 * nodes.size()), along_x;
  fluid.velocity(nodes, velocity);
  for (std::size_t z = 0; z < nodes.size(); ++z) along_x.push_back(velocity[3 * z]);
  return along_x;
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0;
  for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - other[k]));
  return largest;
}

}  // namespace

std::vector<double> sheet_heights(const LayersStudy& study) {
  require_valid(study);
  std::vector<double> heights;
  for (int k = 0; k < study.n_places; ++k)
    heights.push_back(study.sheet * study.height + (k + 0.5) / study.n_places - 0.5);
  return heights;
}

TwoLayers exact_layers(const LayersStudy& study, double sheet_height) {
  auto layers = layers_with_force(study, sheet_height, 0);
  if (study.flow == LayersFlow::couette) {
    layers.wall_velocity = speed;
  } else {
    layers.force = speed / layers_with_force(study, study.sheet * study.height, 1).largest_speed();
  }
  return layers;
}

std::vector<double> node_viscosities(const LayersStudy& study, double sheet_height) {
  const auto [below, above] = viscosities_of(study);
  std::vector<double> viscosities;
  for (int z = 0; z < study.height; ++z) {
    const double share = std::clamp(sheet_height - z, 0.0, 1.0);
    switch (study.form) {
      case NodeViscosity::sharp:
        viscosities.push_back(share > 0.5 ? below : above);
        break;
      case NodeViscosity::harmonic:
        viscosities.push_back(1 / (share / below + (1 - share) / above));
        break;
      case NodeViscosity::arithmetic:
        viscosities.push_back(share * below + (1 - share) * above);
        break;
    }
  }
  return viscosities;
}

std::vector<double> steady_velocities(const LayersStudy& study, double sheet_height) {
  const auto fluid = fluid_at_rest(study, sheet_height);
  const int span = decay_steps(study);
  auto velocity = velocities_along_x(*fluid);
  double change = 0, largest = 0;
  for (int done = 0; done < study.most_spans; ++done) {
    for (int step = 0; step < span; ++step) fluid->step();
    const auto before = std::exchange(velocity, velocities_along_x(*fluid));
    change = largest_difference(velocity, before);
    largest = *std::max_element(velocity.begin(), velocity.end());
    if (change <= study.steadiness * largest) return velocity;
  }
  throw RunError(
      fmt::format("the flow of height {} and viscosity ratio {} is not steady after {} steps: "
                  "velocities still change by {:.2g} of the largest one in {} steps, and the "
                  "steadiness asked for is {}; give a greater one",
                  study.height, study.viscosity_ratio, std::int64_t{study.most_spans} * span,
                  change / largest, span, study.steadiness));
}

}  // namespace tanktread::driver
