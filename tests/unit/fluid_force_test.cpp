// The contract of forces, and the momentum and mass that follow from it.
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

LatticeBoltzmannSettings periodic_box() {
  LatticeBoltzmannSettings settings;
  settings.shape = {11, 6, 5};
  settings.relaxation_time = 0.8;
  settings.threads = 1;
  return settings;
}

/// Sum over nodes of rho u (rho = 1 without inertia).
Vector momentum(const Fluid& fluid, bool inertia) {
  const auto [density, velocity] = moments(fluid);
  Vector sum{};
  for (std::size_t node = 0; node < density.size(); ++node)
    for (int component = 0; component < 3; ++component)
      sum[component] += (inertia ? density[node] : 1.0) * velocity[3 * node + component];
  return sum;
}

double mass_change(const Fluid& fluid) {
  double sum = 0.0;
  for (const double population : populations(fluid)) sum += population;
  return sum;
}

/// What rounding may do to a sum over the nodes of a box after n steps: a collision makes about 60 roundings
/// of numbers no larger than `scale`, and the sum as many again as it has terms.
double sum_rounding(const Fluid& fluid, int n_steps, double scale) {
  return static_cast<double>(fluid.shape().size()) * (60.0 * n_steps + n_populations) * eps * scale;
}

class FluidForce : public testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<Fluid> make(const LatticeBoltzmannSettings& settings) const {
    return GetParam() ? make_lattice_boltzmann(settings) : make_plain_lattice_boltzmann(settings);
  }
};
INSTANTIATE_TEST_SUITE_P(fast_and_plain, FluidForce, testing::Bool());

TEST_P(FluidForce, adds_up_and_is_cleared) {
  auto settings = periodic_box();
  settings.body_force = {1e-4, 0, 0};
  const auto fluid = make(settings);
  const std::vector<std::int64_t> nodes = {7, 300, 7};
  const Numbers force = {1, 2, 3, 4, 5, 6, 10, 20, 30};
  fluid->add_force(nodes, force);
  fluid->add_force(std::vector<std::int64_t>{300}, Numbers{100, 200, 300});

  Numbers expected(3 * settings.shape.size(), 0.0);  // without the body force
  expected[21] = 11, expected[22] = 22, expected[23] = 33;
  expected[900] = 104, expected[901] = 205, expected[902] = 306;
  EXPECT_EQ(Numbers(fluid->force().begin(), fluid->force().end()), expected);
  fluid->clear_force();
  EXPECT_EQ(largest({fluid->force().begin(), fluid->force().end()}), 0.0);
}

// Two capsules share a row: the second may add to the left of the first.
TEST_P(FluidForce, acts_and_is_cleared_whatever_the_order_of_nodes) {
  const auto ascending = make(periodic_box()), descending = make(periodic_box());
  ascending->add_force(std::vector<std::int64_t>{3, 8}, Numbers{1e-3, 2e-3, 3e-3, -4e-3, 5e-3, 6e-3});
  descending->add_force(std::vector<std::int64_t>{8}, Numbers{-4e-3, 5e-3, 6e-3});
  descending->add_force(std::vector<std::int64_t>{3}, Numbers{1e-3, 2e-3, 3e-3});
  ascending->step();
  descending->step();
  EXPECT_EQ(populations(*ascending), populations(*descending));
  descending->clear_force();
  EXPECT_EQ(Numbers(descending->force().begin(), descending->force().end()),
            Numbers(3 * periodic_box().shape.size(), 0.0));
}

// The fast solver keeps the velocity that a step met where it was pushed: nothing may show whether it looks
// there or computes it anew, as moments() does.
TEST_P(FluidForce, velocity_is_that_of_the_moments_to_the_last_bit) {
  struct Flow {
    int nx, wall_axis;
    bool inertia;
    Vector body_force;
    Storage storage = Storage::double_precision;
  };
  // Rows shorter than a pack, of whole packs, with a part of one at the end; walls across x, too.
  for (const auto& flow :
       {Flow{3, -1, true, {0, 0, 0}}, Flow{8, 0, true, {0, 0, 0}}, Flow{24, 0, false, {0, 0, 0}},
        Flow{27, 1, true, {1e-4, -2e-4, 3e-4}}, Flow{27, 2, false, {0, 0, 0}}, Flow{27, 2, true, {0, 0, 0}},
        Flow{7, 0, true, {0, 0, 0}, Storage::single_precision},
        Flow{32, 1, false, {0, 0, 0}, Storage::single_precision},
        Flow{43, 2, true, {1e-4, -2e-4, 3e-4}, Storage::single_precision}}) {
    auto settings = periodic_box();
    settings.shape = {flow.nx, 6, 5};
    if (flow.wall_axis >= 0) settings.walls = moving_walls(flow.wall_axis);
    settings.inertia = flow.inertia;
    settings.body_force = flow.body_force;
    settings.storage = flow.storage;
    const auto fluid = make(settings);
    const auto nodes = all_nodes(settings.shape);
    const auto expect_the_same = [&](const std::string& when) {
      Numbers velocity(3 * nodes.size());
      fluid->velocity(nodes, velocity);
      EXPECT_EQ(velocity, moments(*fluid).velocity)
          << "nx " << flow.nx << ", walls " << flow.wall_axis << ", " << when;
    };
    disturb(*fluid);
    const auto start = fluid->state();
    for (unsigned turn = 0; turn < 3; ++turn) {
      const auto forces = some_forces(settings.shape, turn);
      fluid->clear_force();
      expect_the_same("cleared");
      fluid->add_force(forces.nodes, forces.force);
      expect_the_same("added");
      fluid->step();
      expect_the_same("after a step");
    }
    const auto more = some_forces(settings.shape, 7);
    fluid->add_force(more.nodes, more.force);
    expect_the_same("added after a step");
    fluid->step();
    fluid->restore(start);
    expect_the_same("restored");
  }
}

// A solver whose force was added and cleared goes on as one that never had it.
TEST_P(FluidForce, leaves_nothing_behind_when_cleared) {
  const auto fluid = make(periodic_box()), untouched = make(periodic_box());
  disturb(*fluid);
  disturb(*untouched);
  const auto forces = some_forces(fluid->shape());
  fluid->add_force(forces.nodes, forces.force);
  fluid->clear_force();
  steps(*fluid, 3);
  steps(*untouched, 3);
  EXPECT_EQ(difference(fluid->state(), untouched->state()), "");
}

TEST_P(FluidForce, at_rest_before_the_first_step) {
  auto settings = periodic_box();
  settings.body_force = {1e-4, -2e-4, 3e-4};
  const auto [density, velocity] = moments(*make(settings));
  for (const double value : density) EXPECT_EQ(value, 1.0);
  // F/2 is added and taken off again: what is left is rounding of F.
  EXPECT_LT(largest(velocity), 4.0 * eps * 3e-4);
}

// n steps under a force F in V nodes give the momentum n F V: nothing else gives or takes any.
TEST_P(FluidForce, gives_its_momentum_each_step) {
  for (const bool inertia : {true, false}) {
    auto settings = periodic_box();
    settings.inertia = inertia;
    settings.body_force = {1e-4, -2e-4, 3e-4};
    const auto fluid = make(settings);
    disturb(*fluid);
    const auto forces = some_forces(settings.shape);
    fluid->add_force(forces.nodes, forces.force);
    Vector per_step;
    for (int component = 0; component < 3; ++component) {
      per_step[component] = settings.body_force[component] * static_cast<double>(settings.shape.size());
      for (std::size_t k = component; k < forces.force.size(); k += 3) per_step[component] += forces.force[k];
    }

    const Vector before = momentum(*fluid, inertia);
    const int n_steps = 17;
    steps(*fluid, n_steps);
    const Vector after = momentum(*fluid, inertia);
    const double tolerance = sum_rounding(*fluid, n_steps, largest(populations(*fluid)));
    ASSERT_LT(tolerance, 1e-4 * std::abs(per_step[0]));
    for (int component = 0; component < 3; ++component)
      EXPECT_NEAR(after[component] - before[component], n_steps * per_step[component], tolerance);
  }
}

TEST_P(FluidForce, from_rest_the_momentum_is_n_force_volume) {
  auto settings = periodic_box();
  settings.body_force = {1e-4, -2e-4, 3e-4};
  const auto fluid = make(settings);
  for (int step = 1; step <= 12; ++step) {
    fluid->step();
    const Vector sum = momentum(*fluid, true);
    for (int component = 0; component < 3; ++component) {
      const double expected =
          step * settings.body_force[component] * static_cast<double>(settings.shape.size());
      EXPECT_NEAR(sum[component], expected, sum_rounding(*fluid, step, 12.0 * 3e-4));
    }
  }
}

TEST_P(FluidForce, mass_is_kept_between_moving_walls) {
  for (const int axis : {0, 1, 2}) {
    auto settings = periodic_box();
    settings.walls = moving_walls(axis);
    settings.body_force = {1e-4, 2e-4, -1e-4};
    const auto fluid = make(settings);
    disturb(*fluid);
    fluid->set_viscosity(random_viscosity(settings.shape));
    const auto forces = some_forces(settings.shape);
    fluid->add_force(forces.nodes, forces.force);
    const double before = mass_change(*fluid);
    const int n_steps = 31;
    steps(*fluid, n_steps);
    EXPECT_NEAR(mass_change(*fluid), before, sum_rounding(*fluid, n_steps, largest(populations(*fluid))));
  }
}

/// Momentum that the walls give to the fluid in the step to come: each population that goes out through a
/// wall with c_i comes back with -c_i, changed by -6 w_i c_i.u_wall (the reference density is 1).
Vector momentum_from_walls(const Fluid& fluid, const WallPair& walls) {
  const Numbers outgoing = populations(fluid);
  const auto shape = fluid.shape();
  const std::array<int, 3> nodes = {shape.nx, shape.ny, shape.nz};
  Vector sum{};
  for_each_node(shape, [&](int x, int y, int z, std::int64_t node) {
    for (int i = 0; i < n_populations; ++i) {
      const auto& c = d3q19::velocity[i];
      const int target = std::array{x, y, z}[walls.axis] + c[walls.axis];
      if (target >= 0 && target < nodes[walls.axis]) continue;
      const Vector& wall = target < 0 ? walls.low_velocity : walls.high_velocity;
      double back = outgoing[n_populations * node + i];
      for (int axis = 0; axis < 3; ++axis) back -= 6.0 * d3q19::weight(i) * c[axis] * wall[axis];
      for (int axis = 0; axis < 3; ++axis) sum[axis] -= c[axis] * (outgoing[n_populations * node + i] + back);
    }
  });
  return sum;
}

// In every step the momentum changes by the body force and by what the walls give.
TEST_P(FluidForce, and_the_walls_give_all_momentum_there_is) {
  for (const int axis : {0, 1, 2}) {
    auto settings = periodic_box();
    settings.walls = moving_walls(axis);
    settings.body_force = {1e-5, 2e-5, 3e-5};
    const auto fluid = make(settings);
    disturb(*fluid);
    const double volume = static_cast<double>(settings.shape.size());
    for (int step = 0; step < 10; ++step) {
      const Vector before = momentum(*fluid, true), from_walls = momentum_from_walls(*fluid, *settings.walls);
      fluid->step();
      const Vector after = momentum(*fluid, true);
      const double tolerance = sum_rounding(*fluid, 1, largest(populations(*fluid)));
      for (int component = 0; component < 3; ++component) {
        EXPECT_NEAR(after[component] - before[component],
                    volume * settings.body_force[component] + from_walls[component], tolerance);
      }
    }
  }
}

// In the steady state the walls take what the body force gives.
TEST_P(FluidForce, is_balanced_by_the_walls_in_the_steady_state) {
  for (const int axis : {0, 1, 2}) {
    auto settings = periodic_box();
    settings.shape = channel(axis, 7);
    settings.walls = moving_walls(axis);
    settings.body_force = {1e-5, 2e-5, 3e-5};
    settings.body_force[axis] = 0.0;
    const auto fluid = make(settings);
    // The slowest motion decays by 1/e in H^2/(pi^2 nu) = 50 steps.
    steps(*fluid, 50 * 40);
    const Vector from_walls = momentum_from_walls(*fluid, *settings.walls);
    const double volume = static_cast<double>(settings.shape.size());
    const double tolerance = sum_rounding(*fluid, 50, largest(populations(*fluid)));
    ASSERT_LT(tolerance, 1e-6 * 1e-5 * volume);
    for (int component = 0; component < 3; ++component)
      EXPECT_NEAR(from_walls[component], -volume * settings.body_force[component], tolerance);
  }
}

// Without inertia the equations are linear. Doubling is exact in binary, so the velocities double bit for
// bit.
TEST_P(FluidForce, doubling_all_causes_doubles_the_flow_only_without_inertia) {
  for (const bool inertia : {false, true}) {
    const auto run = [&](double factor) {
      auto settings = periodic_box();
      settings.inertia = inertia;
      settings.walls = moving_walls(1);
      for (auto* wall : {&settings.walls->low_velocity, &settings.walls->high_velocity})
        for (auto& component : *wall) component *= factor;
      settings.body_force = {factor * 1e-4, factor * 2e-4, 0};
      const auto fluid = make(settings);
      auto forces = some_forces(settings.shape);
      for (auto& component : forces.force) component *= factor;
      fluid->add_force(forces.nodes, forces.force);
      steps(*fluid, 25);
      return moments(*fluid).velocity;
    };
    Numbers once = run(1.0);
    const Numbers twice = run(2.0);
    for (auto& component : once) component *= 2.0;
    EXPECT_EQ(once == twice, !inertia);
  }
}

// A force against a wall moves nothing. A lane beyond the end of a row must not pass for a node that it
// moves.
TEST_P(FluidForce, the_highest_speed_is_that_of_a_node) {
  for (const int nx : {8, 13, 16}) {
    auto settings = periodic_box();
    settings.shape = {nx, 4, 6};
    settings.walls = WallPair{};
    settings.body_force = {0, 0, 1e-4};
    settings.inertia = false;
    const auto fluid = make(settings);
    double highest = 1.0;
    for (int step = 0; step < 400; ++step) highest = fluid->step();
    const double at_nodes = largest(moments(*fluid).velocity);
    EXPECT_LT(at_nodes, 1e-5);  // F/2 is 5e-5
    EXPECT_NEAR(highest, at_nodes, 1e-12) << "nx " << nx;
  }
}

TEST_P(FluidForce, velocity_on_nodes_equals_moments) {
  for (const bool inertia : {true, false}) {
    auto settings = periodic_box();
    settings.inertia = inertia;
    settings.walls = moving_walls(0);
    const auto fluid = make(settings);
    disturb(*fluid);
    const auto forces = some_forces(settings.shape);
    fluid->add_force(forces.nodes, forces.force);
    for (int step = 0; step < 3; ++step) {
      fluid->step();
      const auto nodes = all_nodes(settings.shape);
      const std::vector<std::int64_t> backwards(nodes.rbegin(), nodes.rend());
      Numbers on_nodes(3 * nodes.size());
      fluid->velocity(backwards, on_nodes);
      const Numbers everywhere = moments(*fluid).velocity;
      for (std::size_t k = 0; k < backwards.size(); ++k)
        for (int component = 0; component < 3; ++component)
          ASSERT_EQ(on_nodes[3 * k + component], everywhere[3 * backwards[k] + component]);
    }
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
