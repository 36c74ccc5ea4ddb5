// The velocity that the next step will meet, asked for before it: by the step itself.
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

struct Solver {
  std::string name;
  Storage storage;
  std::unique_ptr<Fluid> (*make)(const LatticeBoltzmannSettings& settings);
};

struct FreeVelocity {
  Numbers velocity, mobility;
  bool operator==(const FreeVelocity&) const = default;
};
FreeVelocity free_velocity(const Fluid& fluid, const std::vector<std::int64_t>& nodes) {
  FreeVelocity found{Numbers(3 * nodes.size(), 7.0), Numbers(nodes.size(), 7.0)};
  fluid.free_velocity(nodes, found.velocity, found.mobility);
  return found;
}
FreeVelocity free_velocity(const Fluid& fluid) {
  return free_velocity(fluid, all_nodes(fluid.shape()));
}

Numbers velocity(const Fluid& fluid) {
  const auto nodes = all_nodes(fluid.shape());
  Numbers velocity(3 * nodes.size());
  fluid.velocity(nodes, velocity);
  return velocity;
}

class FluidFreeVelocity : public testing::TestWithParam<Solver> {
 protected:
  /// Calls body(settings) for walls across each axis and none, rows that are shorter than a pack, end with a
  /// part of one and are of whole packs, with inertia and without, with a body force and without.
  void for_each_flow(const std::function<void(const LatticeBoltzmannSettings&)>& body) const {
    for (const int wall_axis : {-1, 0, 1, 2})
      for (const int nx : {3, 7, 16, 37, 48})
        for (const bool inertia : {true, false})
          for (const bool body_force : {true, false}) {
            SCOPED_TRACE("walls " + std::to_string(wall_axis) + ", nx " + std::to_string(nx) + ", inertia " +
                         std::to_string(inertia) + ", body force " + std::to_string(body_force));
            LatticeBoltzmannSettings settings;
            settings.shape = {nx, 5, 4};
            settings.relaxation_time = 0.7;
            settings.threads = 1;
            settings.storage = GetParam().storage;
            settings.inertia = inertia;
            if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
            if (body_force) settings.body_force = {2e-4, -1e-4, 3e-4};
            body(settings);
          }
  }

  std::unique_ptr<Fluid> make(const LatticeBoltzmannSettings& settings) const {
    auto fluid = GetParam().make(settings);
    disturb(*fluid);
    return fluid;
  }

  /// How far two velocities may be apart, one from what comes in, one from what goes out. Each sums 10
  /// populations, 5 differences of two and 4 sums of these, adds half a force and divides: a dozen roundings.
  /// Between them lies a collision, of no more than 60 roundings of a population (fluid_collision_test), of
  /// which 10 make a component. Every rounding is below eps/2 times a partial sum, below 10 times the largest
  /// population; but those of a population are below eps/2 times 3 times the largest, as there:
  /// (2 x 12 x 10 + 10 x 60 x 3) eps/2, and rho is over 0.9. Forces are below the largest population.
  double tolerance(const Fluid& fluid) const {
    return 1200.0 * epsilon(GetParam().storage) * largest(populations(fluid));
  }
};
INSTANTIATE_TEST_SUITE_P(
    every, FluidFreeVelocity,
    testing::Values(Solver{"double_precision", Storage::double_precision, make_lattice_boltzmann},
                    Solver{"single_precision", Storage::single_precision, make_lattice_boltzmann},
                    Solver{"plain", Storage::double_precision, make_plain_lattice_boltzmann}),
    [](const auto& solver) { return solver.param.name; });

void expect_near(const Numbers& found, const Numbers& expected, double tolerance, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    ASSERT_NEAR(found[k], expected[k], tolerance) << what << ", number " << k;
}

// Of each kind of turn two steps, each from the same state without a force and with one.
TEST_P(FluidFreeVelocity, is_what_the_next_step_meets_and_mobility_what_a_force_adds) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto fluid = make(settings);
    for (unsigned step = 0; step < 4; ++step) {
      const auto found = free_velocity(*fluid);
      const State before = fluid->state();
      fluid->clear_force();
      fluid->step();
      // Less than half a body force (5e-5 and more) and what a wall adds (6 w u_wall, 1.6e-3 and more).
      ASSERT_LT(tolerance(*fluid), 1e-5);
      expect_near(found.velocity, velocity(*fluid), tolerance(*fluid), "step " + std::to_string(step));

      fluid->restore(before);
      fluid->clear_force();
      const auto forces = some_forces(settings.shape, step);
      fluid->add_force(forces.nodes, forces.force);
      Numbers expected = found.velocity;
      for (std::size_t k = 0; k < forces.force.size(); ++k) {
        const auto node = static_cast<std::size_t>(forces.nodes[k / 3]);
        expected[3 * node + k % 3] += found.mobility[node] * forces.force[k];
      }
      fluid->step();
      expect_near(expected, velocity(*fluid), tolerance(*fluid), "forced step " + std::to_string(step));
    }
  });
}

// A collision keeps mass: the density that the step met is the one that moments() tells after it. That is 1
// and a sum of 19 populations, rounded at each, and a collision between; with the product that is 1, 4
// roundings more.
TEST_P(FluidFreeVelocity, mobility_is_half_the_inverse_of_the_density) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto fluid = make(settings);
    for (int step = 0; step < 2; ++step) {
      const auto mobility = free_velocity(*fluid).mobility;
      fluid->step();
      const auto density = moments(*fluid).density;
      const double rounding = 4.0 * epsilon(settings.storage) + 2.0 * tolerance(*fluid);
      for (std::size_t node = 0; node < mobility.size(); ++node) {
        if (settings.inertia) {
          ASSERT_NEAR(2.0 * mobility[node] * density[node], 1.0, rounding) << "node " << node;
        } else {
          ASSERT_EQ(mobility[node], 0.5) << "node " << node;
        }
      }
    }
  });
}

TEST_P(FluidFreeVelocity, changes_nothing) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto asked = make(settings), untouched = make(settings);
    for (unsigned step = 0; step < 3; ++step) {
      const auto forces = some_forces(settings.shape, step);
      for (auto* fluid : {asked.get(), untouched.get()}) {
        fluid->clear_force();
        fluid->add_force(forces.nodes, forces.force);
        fluid->step();
      }
      free_velocity(*asked);
      ASSERT_EQ(difference(asked->state(), untouched->state()), "") << "step " << step;
      ASSERT_EQ(velocity(*asked), velocity(*untouched)) << "step " << step;
    }
  });
}

TEST_P(FluidFreeVelocity, does_not_depend_on_the_force_field) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto fluid = make(settings);
    for (unsigned step = 0; step < 2; ++step) {
      const auto found = free_velocity(*fluid);
      const auto forces = some_forces(settings.shape, step);
      fluid->add_force(forces.nodes, forces.force);
      ASSERT_EQ(free_velocity(*fluid), found) << "step " << step;
      fluid->clear_force();
      ASSERT_EQ(free_velocity(*fluid), found) << "step " << step;
      fluid->add_force(forces.nodes, forces.force);
      fluid->step();
    }
  });
}

TEST_P(FluidFreeVelocity, does_not_depend_on_the_number_of_threads) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto one = make(settings);
    auto with_more = settings;
    with_more.threads = 3;
    const auto several = make(with_more);
    for (int step = 0; step < 2; ++step) {
      ASSERT_EQ(free_velocity(*one), free_velocity(*several)) << "step " << step;
      one->step();
      several->step();
    }
  });
}

// A node's numbers are its own, whichever nodes are asked for beside it and in whatever order.
TEST_P(FluidFreeVelocity, does_not_depend_on_the_other_nodes) {
  for_each_flow([&](const LatticeBoltzmannSettings& settings) {
    const auto fluid = make(settings);
    for (int step = 0; step < 2; ++step, fluid->step()) {
      const auto everywhere = free_velocity(*fluid);
      const std::int64_t n = settings.shape.size();
      std::vector<std::int64_t> nodes;
      for (std::int64_t k = 0; k < n; ++k) nodes.push_back(k * k % n);  // to and fro, some again
      for (std::int64_t node = n - 1; node >= 0; node -= 3) nodes.push_back(node);
      const auto found = free_velocity(*fluid, nodes);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        ASSERT_EQ(found.mobility[k], everywhere.mobility[nodes[k]]);
        for (int component = 0; component < 3; ++component)
          ASSERT_EQ(found.velocity[3 * k + component], everywhere.velocity[3 * nodes[k] + component]);
      }
    }
  });
}

TEST_P(FluidFreeVelocity, of_no_nodes_is_nothing) {
  LatticeBoltzmannSettings settings;
  settings.shape = {3, 1, 1};
  EXPECT_NO_THROW(free_velocity(*make(settings), {}));
}

}  // namespace
}  // namespace tanktread::fluid::test
