// What drives a steady flow is what it dissipates.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

Numbers dissipation(const Fluid& fluid) {
  Numbers power(fluid.shape().size());
  fluid.dissipation(power);
  return power;
}

double sum(const Numbers& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

/// A steady flow between walls from the first step on.
LatticeBoltzmannSettings developed(int axis, int height, double relaxation_time, bool inertia) {
  LatticeBoltzmannSettings settings;
  settings.shape = channel(axis, height);
  settings.relaxation_time = relaxation_time;
  settings.inertia = inertia;
  settings.start = Start::developed;
  settings.walls = WallPair{axis, {0, 0, 0}, {0, 0, 0}};
  settings.threads = 1;
  return settings;
}

constexpr double relaxation_times[] = {0.55, 0.8, 1.0, 1.7};

// f_i = w_i (3 c.u - 3 tau c_s c.u') streams into itself, so that the strain rate is u'/2 on every node: the
// dissipation is nu u'^2, and the walls give nu u' times the difference of their velocities. Some 40
// roundings a step, and few steps. With inertia as without: the terms in u u are those of the equilibrium.
TEST(FluidPower, of_walls_is_what_couette_flow_dissipates) {
  for (const int axis : {0, 1, 2})
    for (const double relaxation_time : relaxation_times) {
      auto settings = developed(axis, 11, relaxation_time, false);
      settings.walls = moving_walls(axis);
      const auto fluid = make_lattice_boltzmann(settings);
      const double viscosity = (relaxation_time - 0.5) / 3.0;
      double difference_squared = 0.0;
      for (int component = 0; component < 3; ++component) {
        const double difference =
            settings.walls->high_velocity[component] - settings.walls->low_velocity[component];
        difference_squared += difference * difference;
      }
      const double of_node = viscosity * difference_squared / (11.0 * 11.0);
      for (int step = 0; step < 4; ++step) {
        const double rounding = 1e4 * eps * 0.05 * 0.05;
        for (const double power : dissipation(*fluid)) EXPECT_NEAR(power, of_node, rounding);
        const double whole = of_node * static_cast<double>(settings.shape.size());
        EXPECT_NEAR(sum_of_wall_power(*fluid), whole, 33 * rounding);
        EXPECT_GT(whole, 1e5 * rounding);
        fluid->step();
      }
    }
}

/// Of flow under a body force F = 1e-5 along the walls: sum F.u, the sum of the dissipation, and the integral
/// of nu u'^2, F^2 H^3/(12 nu), over the cross-section.
struct ChannelPower {
  double force, dissipation, exact;
};
ChannelPower channel_power(int axis, int height, double relaxation_time, bool inertia) {
  auto settings = developed(axis, height, relaxation_time, inertia);
  const int along = (axis + 1) % 3;
  settings.body_force[along] = 1e-5;
  const auto fluid = make_lattice_boltzmann(settings);
  steps(*fluid, 3);
  const auto velocity = moments(*fluid).velocity;
  double force = 0.0;
  for (std::size_t node = 0; node < velocity.size() / 3; ++node) force += 1e-5 * velocity[3 * node + along];
  const double viscosity = (relaxation_time - 0.5) / 3.0;
  const double section = static_cast<double>(settings.shape.size()) / height;
  return {force, sum(dissipation(*fluid)), section * 1e-10 * std::pow(height, 3) / (12.0 * viscosity)};
}

// u = F s (H - s)/(2 nu) and u' are those of the exact flow on the nodes, so both sums are its integrals by
// the mid-point rule: sum s (H - s) = H^3/6 (1 + 1/(2 H^2)) and sum (H - 2 s)^2 = H^3/3 (1 - 1/H^2). What is
// between them is lost in parts of the populations that have no meaning for the flow.
TEST(FluidPower, of_a_body_force_is_what_channel_flow_dissipates_to_second_order) {
  for (const int axis : {0, 1, 2})
    for (const double relaxation_time : relaxation_times)
      for (const int height : {8, 16, 32}) {
        const auto power = channel_power(axis, height, relaxation_time, false);
        const double h_squared = height * height;
        // u of up to 1e-5 x 32^2/(8 x 0.0167) = 0.08 in sums of 32 x 3 nodes.
        EXPECT_NEAR(power.force / power.exact, 1.0 + 0.5 / h_squared, 1e-10);
        EXPECT_NEAR(power.dissipation / power.exact, 1.0 - 1.0 / h_squared, 1e-10);
      }
}

// With inertia the density stays, and terms in u F are what they are for any force: Mach numbers of 0.02
// leave their square.
TEST(FluidPower, of_a_body_force_is_the_same_with_inertia) {
  for (const double relaxation_time : {0.8, 1.0, 1.7}) {
    const auto without = channel_power(2, 16, relaxation_time, false);
    const auto with = channel_power(2, 16, relaxation_time, true);
    EXPECT_NEAR(with.force, without.force, 1e-3 * without.force);
    EXPECT_NEAR(with.dissipation, without.dissipation, 1e-3 * without.dissipation);
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
