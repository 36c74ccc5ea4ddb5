// Steady flows between parallel walls, of which the lattice Boltzmann method has the exact solution.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

constexpr int height = 9;

/// Steps in which the slowest mode between the walls, exp(-pi^2 nu t/H^2), falls by 1/e.
double decay_steps(double viscosity) {
  return height * height / (std::numbers::pi * std::numbers::pi * viscosity);
}

/// Steps after which exp(-36) = 2e-16 is left of the start.
int steps_to_steady_state(double viscosity) {
  return static_cast<int>(36.0 * decay_steps(viscosity)) + 1;
}

/// What rounding may do to a steady velocity, relative to the speed: a step makes about 40 roundings of it,
/// and the flow forgets them after decay_steps. (2e-12 at the lowest viscosity here.)
double rounding(double viscosity) {
  return 40.0 * eps * (1.0 + decay_steps(viscosity));
}

using Profile = std::function<Vector(double distance_from_low_wall)>;

/// Largest difference between a component of the velocity and the profile, over all nodes.
double largest_error(const Fluid& fluid, int axis, const Profile& exact) {
  const auto velocity = moments(fluid).velocity;
  double error = 0.0;
  for_each_node(fluid.shape(), [&](int x, int y, int z, std::int64_t node) {
    const Vector expected = exact(std::array{x, y, z}[axis] + 0.5);
    for (int component = 0; component < 3; ++component)
      error = std::max(error, std::abs(velocity[3 * node + component] - expected[component]));
  });
  return error;
}

struct Channel {
  int axis;
  double relaxation_time;
  bool inertia;

  double viscosity() const { return (relaxation_time - 0.5) / 3.0; }

  LatticeBoltzmannSettings settings() const {
    LatticeBoltzmannSettings settings;
    settings.shape = channel(axis, height);
    settings.walls = WallPair{axis, {0, 0, 0}, {0, 0, 0}};
    settings.relaxation_time = relaxation_time;
    settings.inertia = inertia;
    settings.threads = 1;
    return settings;
  }

  /// Along both axes of the walls, in unlike shares, `size` in all.
  Vector along_walls(double size) const {
    Vector vector{};
    vector[(axis + 1) % 3] = 0.8 * size;
    vector[(axis + 2) % 3] = -0.6 * size;
    return vector;
  }

  /// The force with which plane Poiseuille flow, u = F s (H - s)/(2 nu), has this speed in the middle.
  double force(double centre_speed) const { return 8.0 * viscosity() * centre_speed / (height * height); }
  Profile poiseuille(double centre_speed) const {
    return [=, *this](double s) {
      return along_walls(centre_speed * 4.0 * s * (height - s) / (height * height));
    };
  }
};

Profile couette(const WallPair& walls) {
  return [=](double s) {
    Vector velocity;
    for (int component = 0; component < 3; ++component)
      velocity[component] =
          walls.low_velocity[component] * (1.0 - s / height) + walls.high_velocity[component] * s / height;
    return velocity;
  };
}

void PrintTo(const Channel& channel, std::ostream* out) {
  *out << "walls across "
       << "xyz"[channel.axis] << ", tau+ " << channel.relaxation_time
       << (channel.inertia ? ", inertia" : ", no inertia");
}

class FluidChannel : public testing::TestWithParam<Channel> {};

constexpr double centre_speed = 1e-3;

// With Lambda = 3/16 (the default) the half-way wall is exactly half-way (Ginzburg and d'Humieres 2003).
TEST_P(FluidChannel, poiseuille_flow_is_exact) {
  const Channel channel = GetParam();
  auto settings = channel.settings();
  settings.body_force = channel.along_walls(channel.force(centre_speed));
  const auto fluid = make_lattice_boltzmann(settings);
  steps(*fluid, steps_to_steady_state(channel.viscosity()));
  const double tolerance = rounding(channel.viscosity());
  ASSERT_LT(tolerance, 1e-10);
  EXPECT_LT(largest_error(*fluid, channel.axis, channel.poiseuille(centre_speed)), tolerance * centre_speed);
}

// Any other Lambda moves the wall: u = F (s (H - s) + 4/3 Lambda - 1/4)/(2 nu), from the same analysis.
TEST_P(FluidChannel, poiseuille_flow_slips_as_the_magic_parameter_says) {
  const Channel channel = GetParam();
  for (const double magic_parameter : {1.0 / 12.0, 1.0 / 4.0}) {
    auto settings = channel.settings();
    settings.magic_parameter = magic_parameter;
    settings.body_force = channel.along_walls(channel.force(centre_speed));
    const auto fluid = make_lattice_boltzmann(settings);
    steps(*fluid, steps_to_steady_state(channel.viscosity()));
    const double slip = 4.0 * centre_speed / (height * height) * (4.0 / 3.0 * magic_parameter - 0.25);
    const auto exact = [&](double s) {
      Vector velocity = channel.poiseuille(centre_speed)(s);
      for (int component = 0; component < 3; ++component)
        velocity[component] += channel.along_walls(slip)[component];
      return velocity;
    };
    EXPECT_LT(largest_error(*fluid, channel.axis, exact), rounding(channel.viscosity()) * centre_speed)
        << "Lambda " << magic_parameter;
  }
}

TEST_P(FluidChannel, couette_flow_is_exact) {
  const Channel channel = GetParam();
  auto settings = channel.settings();
  settings.walls = moving_walls(channel.axis);
  const auto fluid = make_lattice_boltzmann(settings);
  steps(*fluid, steps_to_steady_state(channel.viscosity()));
  const double wall_speed = 0.05;  // of the faster wall, rounded up
  const double tolerance = rounding(channel.viscosity()) * wall_speed;
  ASSERT_LT(tolerance, 1e-12);
  EXPECT_LT(largest_error(*fluid, channel.axis, couette(*settings.walls)), tolerance);
}

// The developed start is the steady state itself, so nothing moves from the first step on.
TEST_P(FluidChannel, developed_start_is_steady) {
  const Channel channel = GetParam();
  auto settings = channel.settings();
  settings.start = Start::developed;
  settings.walls = moving_walls(channel.axis);
  settings.body_force = channel.along_walls(channel.force(centre_speed));
  const auto fluid = make_lattice_boltzmann(settings);
  const auto exact = [&](double s) {
    Vector velocity = couette(*settings.walls)(s);
    for (int component = 0; component < 3; ++component)
      velocity[component] += channel.poiseuille(centre_speed)(s)[component];
    return velocity;
  };
  for (int step = 0; step <= 20; ++step) {
    if (step > 0) fluid->step();
    // 40 roundings a step of a speed below 0.05.
    EXPECT_LT(largest_error(*fluid, channel.axis, exact), 40.0 * eps * (step + 1) * 0.05) << "step " << step;
  }
}

std::vector<Channel> channels() {
  std::vector<Channel> channels;
  for (const int axis : {0, 1, 2})
    for (const double relaxation_time : {0.6, 1.0, 2.0})
      for (const bool inertia : {true, false}) channels.push_back({axis, relaxation_time, inertia});
  return channels;
}
INSTANTIATE_TEST_SUITE_P(every, FluidChannel, testing::ValuesIn(channels()));

}  // namespace
}  // namespace tanktread::fluid::test
