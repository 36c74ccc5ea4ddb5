// The powers that a solver tells: dissipation of every node, power of the walls.
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

Numbers dissipation(const Fluid& fluid) {
  Numbers power(fluid.shape().size(), 7.0);
  fluid.dissipation(power);
  return power;
}

/// Calls body(settings) for walls across each axis and none, rows that are shorter than a pack, end with a
/// part of one and are of whole packs, with inertia and without.
void for_each_flow(Storage storage, const std::function<void(const LatticeBoltzmannSettings&)>& body) {
  for (const int wall_axis : {-1, 0, 1, 2})
    for (const int nx : {3, 7, 16, 37, 48})
      for (const bool inertia : {true, false}) {
        SCOPED_TRACE("walls " + std::to_string(wall_axis) + ", nx " + std::to_string(nx) + ", inertia " +
                     std::to_string(inertia));
        LatticeBoltzmannSettings settings;
        settings.shape = {nx, 5, 4};
        settings.relaxation_time = 0.7;
        settings.threads = 1;
        settings.storage = storage;
        settings.inertia = inertia;
        settings.body_force = {2e-4, -1e-4, 3e-4};
        if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
        body(settings);
      }
}

/// A wild flow with forces and a viscosity for every node. @param step whose parity says which turn is next
std::unique_ptr<Fluid> wild_flow(const LatticeBoltzmannSettings& settings, std::int64_t step) {
  auto fluid = make_lattice_boltzmann(settings);
  disturb(*fluid);
  auto state = fluid->state();
  state.step = step;
  fluid->restore(state);
  fluid->set_viscosity(random_viscosity(settings.shape));
  const auto forces = some_forces(settings.shape);
  fluid->add_force(forces.nodes, forces.force);
  return fluid;
}

class FluidDissipation : public testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(every, FluidDissipation, testing::ValuesIn(storages),
                         [](const auto& storage) { return name_of(storage.param); });

// The fast and the plain solver from the same state. An entry of Pi sums 10 populations and less of the rest,
// below 12 times the largest population f, in some 30 roundings, each below eps/2 times that: off by 180 eps
// f. The dissipation has the squares of 9 entries, 9 x 2 x 12 x 180 eps f^2, times at most 3/4, twice; to
// single precision the rates are rounded too.
TEST_P(FluidDissipation, is_that_of_the_plain_solver) {
  for_each_flow(GetParam(), [&](const LatticeBoltzmannSettings& settings) {
    for (const std::int64_t step : {0, 1}) {
      const auto fast = wild_flow(settings, step);
      const auto plain = make_plain_lattice_boltzmann(settings);
      plain->restore(fast->state());
      const double f = largest(populations(*fast));
      const double tolerance = 6e4 * epsilon(GetParam()) * f * f;
      const auto found = dissipation(*fast), expected = dissipation(*plain);
      for (std::size_t node = 0; node < found.size(); ++node)
        ASSERT_NEAR(found[node], expected[node], tolerance) << "node " << node << ", step " << step;
      EXPECT_GT(largest(found), 10.0 * tolerance);
      // 5 links a node, each a product of a wall's speed below 0.06 and populations.
      const double of_walls = 0.06 * f * 1e3 * static_cast<double>(settings.shape.size());
      EXPECT_NEAR(sum_of_wall_power(*fast), sum_of_wall_power(*plain), epsilon(GetParam()) * of_walls);
      EXPECT_EQ(sum_of_wall_power(*fast) != 0.0, settings.walls.has_value());
    }
  });
}

TEST_P(FluidDissipation, is_never_negative_and_changes_nothing) {
  for_each_flow(GetParam(), [&](const LatticeBoltzmannSettings& settings) {
    const auto fluid = wild_flow(settings, 0);
    const auto before = fluid->state();
    for (const double power : dissipation(*fluid)) ASSERT_GE(power, 0.0);
    sum_of_wall_power(*fluid);
    EXPECT_EQ(difference(fluid->state(), before), "");
  });
}

TEST_P(FluidDissipation, does_not_depend_on_threads) {
  LatticeBoltzmannSettings settings;
  settings.shape = {37, 9, 11};
  settings.storage = GetParam();
  settings.walls = moving_walls(1);
  settings.threads = 1;
  const auto one = wild_flow(settings, 0);
  for (const int threads : {2, 3, 7}) {
    settings.threads = threads;
    const auto several = wild_flow(settings, 0);
    EXPECT_EQ(dissipation(*several), dissipation(*one));
    EXPECT_EQ(wall_power(*several), wall_power(*one));
  }
}

TEST(FluidDissipationSize, must_be_one_number_a_node) {
  LatticeBoltzmannSettings settings;
  settings.shape = {4, 3, 2};
  for (const auto make : {make_lattice_boltzmann, make_plain_lattice_boltzmann}) {
    Numbers power(23);
    EXPECT_THROW(make(settings)->dissipation(power), std::invalid_argument);
    EXPECT_THROW(make(settings)->wall_power(power), std::invalid_argument);
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
