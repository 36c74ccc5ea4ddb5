// A viscosity of each node, set by lists of nodes: what counts is what each node has, not how it came by it.
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

using Nodes = std::vector<std::int64_t>;

constexpr double relaxation_time = 0.7;

/// A box whose rows end within a pack of either storage.
LatticeBoltzmannSettings settings_of(Storage storage, int wall_axis = -1, int threads = 1,
                                     const GridShape& shape = {37, 5, 4}) {
  LatticeBoltzmannSettings settings;
  settings.storage = storage;
  settings.shape = shape;
  if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
  settings.relaxation_time = relaxation_time;
  settings.threads = threads;
  return settings;
}

std::unique_ptr<Fluid> disturbed(const LatticeBoltzmannSettings& settings) {
  auto fluid = make_lattice_boltzmann(settings);
  disturb(*fluid);
  return fluid;
}

/// The viscosity that a solver of these settings has without any set, by its own state.
double own_viscosity(const LatticeBoltzmannSettings& settings) {
  const auto fluid = make_lattice_boltzmann(settings);
  fluid->set_viscosity(Nodes{0}, Numbers{0.3});
  return array(fluid->state(), "viscosity").back();
}

/// Viscosities of all that a class of a pack can be: whole packs of the settings' viscosity, of one of
/// `n_values` others (16 of them are more than the solver's table holds), and borders within a pack between
/// two values and between many.
Numbers layered_viscosity(const LatticeBoltzmannSettings& settings, int n_values, unsigned seed = 0) {
  const double own = own_viscosity(settings);
  Numbers viscosity(settings.shape.size(), own);
  const auto single = random_numbers(viscosity.size(), 0.1, seed + 7);
  for_each_node(settings.shape, [&](int x, int y, int z, std::int64_t node) {
    const int row = y + settings.shape.ny * z;
    const double value = 0.02 + 0.01 * ((row + static_cast<int>(seed)) % n_values);
    // Borders that leave the first node of a pack alone, and the last.
    if (row % 3 == 0 && x >= 1 && x < 31) viscosity[node] = value;
    if (row % 3 == 1 && x >= 16) viscosity[node] = value;                    // borders between packs
    if (row % 3 == 2 && x % 11 == 0) viscosity[node] = 0.15 + single[node];  // each node another
  });
  return viscosity;
}

Numbers values_at(const Nodes& nodes, const Numbers& viscosity) {
  Numbers values;
  for (const auto node : nodes) values.push_back(viscosity[node]);
  return values;
}

/// `n` nodes in an order of no meaning, always the same.
Nodes shuffled(Nodes nodes, unsigned seed) {
  std::mt19937_64 generator(seed);
  for (std::size_t k = nodes.size(); k > 1; --k) std::swap(nodes[k - 1], nodes[generator() % k]);
  return nodes;
}

/// Forces on some nodes, so that every way through the step is taken.
void push(Fluid& fluid) {
  const auto forces = some_forces(fluid.shape());
  fluid.clear_force();
  fluid.add_force(forces.nodes, forces.force);
}

/// Goes on with both and compares after each turn.
void expect_same(Fluid& expected, Fluid& found, const std::string& what) {
  push(expected);
  push(found);
  for (int step = 0; step < 4; ++step) {
    EXPECT_EQ(expected.step(), found.step()) << what;
    ASSERT_EQ(difference(expected.state(), found.state()), "") << what << ", step " << step;
  }
}

class FluidViscosity : public testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(every, FluidViscosity, testing::ValuesIn(storages),
                         [](const auto& storage) { return name_of(storage.param); });

TEST_P(FluidViscosity, by_lists_is_that_by_the_whole_field) {
  for (const int nx : {3, 8, 16, 19, 37, 48}) {
    for (const int axis : {-1, 0, 2}) {
      for (const int n_values : {1, 3, 40}) {
        const auto settings = settings_of(GetParam(), axis, 1, {nx, 5, 10});
        const Numbers viscosity = layered_viscosity(settings, n_values);
        const auto whole = disturbed(settings), all_listed = disturbed(settings),
                   changed = disturbed(settings), one_by_one = disturbed(settings),
                   shuffled_in_parts = disturbed(settings);
        whole->set_viscosity(viscosity);

        const Nodes all = all_nodes(settings.shape);
        all_listed->set_viscosity(all, viscosity);

        Nodes differing;
        const double own = own_viscosity(settings);
        std::ranges::copy_if(all, std::back_inserter(differing),
                             [&](auto node) { return viscosity[node] != own; });
        changed->set_viscosity(differing, values_at(differing, viscosity));

        for (const auto node : shuffled(differing, 1))
          one_by_one->set_viscosity(Nodes{node}, Numbers{viscosity[node]});

        const Nodes mixed_up = shuffled(all, 2);
        for (std::size_t begin = 0; begin < mixed_up.size(); begin += 17) {
          const Nodes part(mixed_up.begin() + begin,
                           mixed_up.begin() + std::min(begin + 17, mixed_up.size()));
          shuffled_in_parts->set_viscosity(part, values_at(part, viscosity));
        }

        const std::string box = ", nx " + std::to_string(nx) + ", walls " + std::to_string(axis) + ", " +
                                std::to_string(n_values) + " values";
        const State start = whole->state();
        const auto compare = [&](Fluid& other, const std::string& what) {
          whole->restore(start);
          whole->set_viscosity(viscosity);
          ASSERT_EQ(difference(start, other.state()), "") << what << box;
          expect_same(*whole, other, what + box);
        };
        compare(*all_listed, "all listed");
        compare(*changed, "those that differ listed");
        compare(*one_by_one, "one by one");
        compare(*shuffled_in_parts, "in parts, out of order");
      }
    }
  }
}

// However a pack is stored, its nodes must do the same: a node alone in its pack, whose neighbours have
// another viscosity each, goes as one of a uniform box.
TEST_P(FluidViscosity, of_the_neighbours_in_a_pack_does_not_show) {
  auto settings = settings_of(GetParam(), 2, 1, {19, 3, 3});
  for (const double value : {0.01, 0.07, own_viscosity(settings), 0.4}) {
    const auto uniform = disturbed(settings);
    uniform->set_viscosity(Numbers(settings.shape.size(), value));
    uniform->step();
    const Numbers expected = populations(*uniform);
    const auto mixed = disturbed(settings);
    const State start = mixed->state();
    for (std::int64_t node = 0; node < settings.shape.size(); ++node) {
      mixed->restore(start);
      mixed->set_viscosity(random_viscosity(settings.shape));
      mixed->set_viscosity(Nodes{node}, Numbers{value});
      mixed->step();
      const Numbers found = populations(*mixed);
      for (int i = 0; i < n_populations; ++i)
        ASSERT_EQ(found[n_populations * node + i], expected[n_populations * node + i]) << "node " << node;
    }
  }
}

// The viscosity of the settings, named by number, is that of the settings to the last bit.
TEST_P(FluidViscosity, of_the_settings_is_no_other_than_none_set) {
  for (const double time : {0.55, 0.7, 0.8, 1.0, 1.3}) {
    auto settings = settings_of(GetParam(), 2);
    settings.relaxation_time = time;
    const auto none = disturbed(settings), set = disturbed(settings), back_again = disturbed(settings);
    set->set_viscosity(Numbers(settings.shape.size(), own_viscosity(settings)));
    const Nodes some = {0, 5, 36, 37, 100};
    back_again->set_viscosity(some, Numbers(some.size(), 0.3));
    back_again->set_viscosity(some, Numbers(some.size(), own_viscosity(settings)));
    for (auto* fluid : {none.get(), set.get(), back_again.get()}) {
      push(*fluid);
      steps(*fluid, 5);
    }
    EXPECT_EQ(populations(*none), populations(*set)) << "tau+ " << time;
    EXPECT_EQ(populations(*none), populations(*back_again)) << "tau+ " << time;
  }
}

// Between steps nodes change to and fro, and values come that were never there before: many more in all than
// the table of known viscosities has room for. What was there before must not show.
TEST_P(FluidViscosity, changed_back_and_forth_leaves_no_trace) {
  const auto settings = settings_of(GetParam(), 2);
  const auto listed = disturbed(settings), whole = disturbed(settings);
  Numbers viscosity = layered_viscosity(settings, 1);
  listed->set_viscosity(all_nodes(settings.shape), viscosity);
  whole->set_viscosity(viscosity);
  for (unsigned step = 0; step < 60; ++step) {
    // Another number of values each time, some as before and some new.
    const Numbers next = step % 4 == 3
                             ? Numbers(viscosity.size(), 0.01 + 0.003 * step)
                             : layered_viscosity(settings, 1 + static_cast<int>(step) % 30, step / 2);
    Nodes nodes;
    for (const auto node : shuffled(all_nodes(settings.shape), step))
      if (next[node] != viscosity[node] || node % 29 == step % 29) nodes.push_back(node);
    listed->set_viscosity(nodes, values_at(nodes, next));
    viscosity = next;

    // A solver that knows nothing of the past.
    const auto fresh = make_lattice_boltzmann(settings);
    whole->set_viscosity(viscosity);
    fresh->restore(whole->state());
    EXPECT_EQ(array(listed->state(), "viscosity"), viscosity);
    for (auto* fluid : {listed.get(), whole.get(), fresh.get()}) {
      push(*fluid);
      fluid->step();
    }
    ASSERT_EQ(difference(whole->state(), fresh->state()), "") << "step " << step;
    ASSERT_EQ(difference(whole->state(), listed->state()), "") << "step " << step;
  }
}

TEST_P(FluidViscosity, of_a_node_listed_twice_is_the_last_one) {
  const auto settings = settings_of(GetParam());
  const auto twice = disturbed(settings), once = disturbed(settings);
  twice->set_viscosity(Nodes{20, 21, 20, 90, 20, 21}, Numbers{0.1, 0.2, 0.3, 0.04, 0.05, 0.06});
  once->set_viscosity(Nodes{21, 90, 20}, Numbers{0.06, 0.04, 0.05});
  expect_same(*once, *twice, "listed twice");
}

TEST_P(FluidViscosity, of_no_node_changes_nothing) {
  const auto settings = settings_of(GetParam());
  const auto fluid = disturbed(settings);
  const State before = fluid->state();
  fluid->set_viscosity(Nodes{}, Numbers{});
  EXPECT_EQ(difference(fluid->state(), before), "");
}

TEST_P(FluidViscosity, does_not_depend_on_the_number_of_threads) {
  const auto run = [&](int threads) {
    const auto settings = settings_of(GetParam(), 2, threads);
    auto fluid = disturbed(settings);
    for (unsigned step = 0; step < 6; ++step) {
      const Numbers viscosity = layered_viscosity(settings, 20, step);
      const Nodes nodes = shuffled(all_nodes(settings.shape), step);
      fluid->set_viscosity(nodes, values_at(nodes, viscosity));
      push(*fluid);
      fluid->step();
    }
    return fluid->state();
  };
  const State one = run(1);
  for (const int threads : {2, 3, 4}) EXPECT_EQ(difference(one, run(threads)), "") << threads << " threads";
}

TEST_P(FluidViscosity, goes_on_from_a_state_as_if_nothing_had_been) {
  for (const int n_values : {1, 40}) {
    const auto settings = settings_of(GetParam(), 1);
    const auto first = disturbed(settings), second = make_lattice_boltzmann(settings);
    const Numbers viscosity = layered_viscosity(settings, n_values);
    const Nodes nodes = shuffled(all_nodes(settings.shape), 3);
    first->set_viscosity(nodes, values_at(nodes, viscosity));
    steps(*first, 3);
    const State kept = first->state();
    EXPECT_EQ(array(kept, "viscosity"), viscosity);
    second->set_viscosity(random_viscosity(settings.shape));  // of which nothing may stay
    second->restore(kept);
    EXPECT_EQ(difference(second->state(), kept), "");
    expect_same(*first, *second, "restored");
    // And goes on to be changed by lists.
    for (auto* fluid : {first.get(), second.get()})
      fluid->set_viscosity(Nodes{3, 70, 71}, Numbers{0.2, 0.2, 0.1});
    expect_same(*first, *second, "restored, then changed");
  }
}

// A refused list must not be half taken over.
TEST_P(FluidViscosity, stays_as_it_was_where_a_list_is_refused) {
  const auto settings = settings_of(GetParam());
  const auto refusing = disturbed(settings), other = disturbed(settings);
  for (auto* fluid : {refusing.get(), other.get()}) fluid->set_viscosity(Nodes{7}, Numbers{0.3});
  EXPECT_THROW(refusing->set_viscosity(Nodes{1, 2, 3}, Numbers{0.1, 0.1, -0.1}), std::invalid_argument);
  EXPECT_THROW(refusing->set_viscosity(Nodes{1, 2, -3}, Numbers{0.1, 0.1, 0.1}), std::invalid_argument);
  expect_same(*other, *refusing, "after a refusal");
}

// As FluidBox.fast_solver_agrees_with_the_plain_one does for a field, with the bound that is derived there:
// 180 eps n of the largest population after n steps.
TEST_P(FluidViscosity, by_lists_agrees_with_the_plain_solver) {
  for (const int axis : {-1, 0, 2}) {
    const auto settings = settings_of(GetParam(), axis);
    const auto fast = make_lattice_boltzmann(settings), plain = make_plain_lattice_boltzmann(settings);
    for (int step = 1; step <= 6; ++step) {
      const Numbers viscosity = layered_viscosity(settings, 20, static_cast<unsigned>(step));
      const Nodes nodes = shuffled(all_nodes(settings.shape), static_cast<unsigned>(step));
      const Nodes part(nodes.begin(), nodes.begin() + nodes.size() / 3);
      for (auto* fluid : {fast.get(), plain.get()}) {
        if (step == 1) disturb(*fluid);
        fluid->set_viscosity(part, values_at(part, viscosity));
        push(*fluid);
        fluid->step();
      }
      const Numbers expected = populations(*plain), found = populations(*fast);
      const double tolerance = 180.0 * epsilon(GetParam()) * step * largest(expected);
      for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_NEAR(found[k], expected[k], tolerance) << "step " << step << ", number " << k;
      EXPECT_EQ(array(fast->state(), "viscosity"), array(plain->state(), "viscosity"));
    }
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
