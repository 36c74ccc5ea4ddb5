// Results that must be the same to the last bit: for any number of threads, after a restore, anywhere in the
// box.
#include <gtest/gtest.h>

#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

/// Walls, forces that change every step, viscosity a node: all there is.
struct Everything {
  explicit Everything(Storage storage, int wall_axis, int threads = 1, const GridShape& shape = {27, 7, 6},
                      bool inertia = true) {
    settings.storage = storage;
    settings.shape = shape;
    if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
    settings.relaxation_time = 0.7;
    settings.inertia = inertia;
    settings.body_force = {0, 0, 0};  // so that nodes without a force take their own way
    settings.threads = threads;
    fluid = make_lattice_boltzmann(settings);
  }
  void start() {
    disturb(*fluid);
    fluid->set_viscosity(random_viscosity(settings.shape));
  }
  void advance(int n_steps) {
    for (int k = 0; k < n_steps; ++k) {
      const auto forces = some_forces(settings.shape, static_cast<unsigned>(fluid->state().step));
      fluid->clear_force();
      fluid->add_force(forces.nodes, forces.force);
      highest_speed.push_back(fluid->step());
    }
  }
  LatticeBoltzmannSettings settings;
  std::unique_ptr<Fluid> fluid;
  Numbers highest_speed;
};

class FluidDeterminism : public testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(every, FluidDeterminism, testing::ValuesIn(storages),
                         [](const auto& storage) { return name_of(storage.param); });

TEST_P(FluidDeterminism, does_not_depend_on_the_number_of_threads) {
  for (const int axis : {-1, 0, 1, 2}) {
    Everything one(GetParam(), axis);
    one.start();
    one.advance(9);
    const auto expected = moments(*one.fluid);
    for (const int threads : {2, 3, 4}) {
      Everything several(GetParam(), axis, threads);
      several.start();
      several.advance(9);
      EXPECT_EQ(difference(one.fluid->state(), several.fluid->state()), "") << threads << " threads";
      EXPECT_EQ(one.highest_speed, several.highest_speed);
      const auto found = moments(*several.fluid);
      EXPECT_EQ(found.velocity, expected.velocity);
      EXPECT_EQ(found.density, expected.density);
    }
  }
}

// The two turns of the in-place update keep the populations in different places: a state taken after either
// must do, in the same object and in another.
TEST_P(FluidDeterminism, goes_on_from_a_state_as_if_nothing_had_been) {
  for (const int axis : {-1, 0, 1, 2}) {
    for (const int n_before : {0, 4, 5}) {
      Everything first(GetParam(), axis);
      first.start();
      first.advance(n_before);
      const State kept = first.fluid->state();
      EXPECT_EQ(kept.step, n_before);
      const auto kept_moments = moments(*first.fluid);
      first.fluid->step();  // with the forces that were there
      first.advance(6);
      const State expected = first.fluid->state();

      Everything second(GetParam(), axis);
      second.fluid->restore(kept);
      EXPECT_EQ(difference(second.fluid->state(), kept), "");
      EXPECT_EQ(moments(*second.fluid).velocity, kept_moments.velocity);
      second.fluid->step();
      second.advance(6);
      EXPECT_EQ(difference(second.fluid->state(), expected), "") << "axis " << axis << ", after " << n_before;

      first.fluid->restore(kept);
      first.fluid->step();
      first.advance(6);
      EXPECT_EQ(difference(first.fluid->state(), expected), "") << "axis " << axis << ", after " << n_before;
    }
  }
}

// A state without viscosities means those of the settings, whatever the object had before.
TEST_P(FluidDeterminism, a_state_without_viscosity_takes_away_the_one_that_was_set) {
  Everything first(GetParam(), 2), second(GetParam(), 2);
  disturb(*first.fluid);
  second.start();
  second.advance(3);
  second.fluid->restore(first.fluid->state());
  first.advance(4);
  second.advance(4);
  EXPECT_EQ(difference(first.fluid->state(), second.fluid->state()), "");
}

// A force of zero that was added is no other than one that was not: a state cannot tell them apart.
TEST_P(FluidDeterminism, a_force_of_zero_changes_nothing) {
  for (const bool inertia : {true, false}) {
    for (const bool own_viscosity : {true, false}) {
      Everything without(GetParam(), 2, 1, {27, 7, 6}, inertia), with(GetParam(), 2, 1, {27, 7, 6}, inertia);
      for (auto* flow : {&without, &with}) {
        disturb(*flow->fluid);
        if (own_viscosity) flow->fluid->set_viscosity(random_viscosity(flow->settings.shape));
        flow->fluid->clear_force();  // a restore lets go of what it knew of rows without a force
      }
      const auto nodes = all_nodes(with.settings.shape);
      with.fluid->add_force(nodes, Numbers(3 * nodes.size(), 0.0));
      steps(*without.fluid, 6);
      steps(*with.fluid, 6);
      EXPECT_EQ(difference(without.fluid->state(), with.fluid->state()), "")
          << "inertia " << inertia << ", a viscosity a node " << own_viscosity;
    }
  }
}

// A node goes through the collision with a force if its neighbours in the pack have one. A force too small to
// change any number takes all nodes that way.
TEST_P(FluidDeterminism, a_force_too_small_to_matter_changes_nothing) {
  for (const bool inertia : {true, false}) {
    Everything without(GetParam(), 2, 1, {27, 7, 6}, inertia), with(GetParam(), 2, 1, {27, 7, 6}, inertia);
    disturb(*without.fluid);
    disturb(*with.fluid);
    const auto nodes = all_nodes(with.settings.shape);
    with.fluid->add_force(nodes, Numbers(3 * nodes.size(), 1e-200));
    steps(*without.fluid, 6);
    steps(*with.fluid, 6);
    EXPECT_EQ(populations(*without.fluid), populations(*with.fluid)) << "inertia " << inertia;
  }
}

/// The values of an array, moved along by whole nodes round the box.
Numbers moved(const Numbers& values, int components, const GridShape& shape, const std::array<int, 3>& by) {
  Numbers result(values.size());
  for_each_node(shape, [&](int x, int y, int z, std::int64_t node) {
    const auto target = shape.index((x + by[0]) % shape.nx, (y + by[1]) % shape.ny, (z + by[2]) % shape.nz);
    for (int k = 0; k < components; ++k) result[components * target + k] = values[components * node + k];
  });
  return result;
}

State moved(State state, const GridShape& shape, const std::array<int, 3>& by) {
  for (auto& array : state.arrays) array.values = moved(array.values, array.components, shape, by);
  return state;
}

// A node at the end of a row goes through other code than one in the middle: its result must not show it.
// So does a node without a force among others that have one.
TEST_P(FluidDeterminism, a_flow_moved_along_stays_the_same_flow) {
  for (const int nx : {3, 8, 13, 16, 19, 32, 37}) {
    for (const int axis : {-1, 1, 2}) {
      const GridShape shape = {nx, 5, 4};
      for (const std::array<int, 3> by : {std::array{1, 0, 0}, {2, 0, 0}, {nx - 1, 3, 1}}) {
        std::array<int, 3> shift = by;
        if (axis >= 0) shift[axis] = 0;  // the walls stay where they are
        Everything here(GetParam(), axis, 1, shape), there(GetParam(), axis, 1, shape);
        here.start();
        const auto forces = some_forces(shape, 5);
        here.fluid->add_force(forces.nodes, forces.force);
        there.fluid->restore(moved(here.fluid->state(), shape, shift));
        for (int step = 0; step < 4; ++step) {
          here.fluid->step();
          there.fluid->step();
          ASSERT_EQ(difference(moved(here.fluid->state(), shape, shift), there.fluid->state()), "")
              << "nx " << nx << ", walls " << axis << ", step " << step;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
