// The fast solver against the plain one, and the two relaxation times against a single one.
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

/// How far the populations of two solvers that do the same sums in another order may be apart after n steps.
/// A step makes no more than 60 roundings of a population, each below eps/2 times the largest term, which is
/// below 3 times the largest population; a collision with rates in (0, 2) does not let differences grow (its
/// norm is sum f^2/w). Room for both solvers: 2 x 60 x eps/2 x 3 n, with the eps of the coarser one.
double rounding(Storage storage, int n_steps, double largest_population) {
  return 180.0 * epsilon(storage) * n_steps * largest_population;
}

double largest_difference(const Numbers& a, const Numbers& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

void expect_same_flow(const Fluid& fast, const Fluid& plain, Storage storage, int n_steps) {
  const Numbers expected = populations(plain);
  const double tolerance = rounding(storage, n_steps, largest(expected));
  // Far below what a wrong term changes: the populations are of the size of 0.1 w.
  ASSERT_LT(tolerance, storage == Storage::double_precision ? 1e-11 : 1e-4);
  EXPECT_LT(largest_difference(populations(fast), expected), tolerance);
  // A moment sums up to 19 populations; density is 1 + a sum, rounded at 1.
  const auto from_fast = moments(fast), from_plain = moments(plain);
  EXPECT_LT(largest_difference(from_fast.velocity, from_plain.velocity), 20.0 * tolerance + eps);
  EXPECT_LT(largest_difference(from_fast.density, from_plain.density),
            20.0 * tolerance + 2.0 * epsilon(storage));
}

struct Box {
  GridShape shape;
  int wall_axis;  ///< -1: none
  bool inertia, forced, own_viscosity;
  Storage storage = Storage::double_precision;
};
void PrintTo(const Box& box, std::ostream* out) {
  *out << box.shape.nx << " x " << box.shape.ny << " x " << box.shape.nz << ", walls " << box.wall_axis
       << (box.inertia ? ", inertia" : "") << (box.forced ? ", forces" : "")
       << (box.own_viscosity ? ", viscosity per node" : "") << ", " << name_of(box.storage);
}

class FluidBox : public testing::TestWithParam<Box> {};

TEST_P(FluidBox, fast_solver_agrees_with_the_plain_one) {
  const Box box = GetParam();
  for (const bool body_force : {false, true}) {
    LatticeBoltzmannSettings settings;
    settings.shape = box.shape;
    if (box.wall_axis >= 0) settings.walls = moving_walls(box.wall_axis);
    settings.relaxation_time = 0.65;
    settings.inertia = box.inertia;
    settings.storage = box.storage;
    if (body_force) settings.body_force = {2e-4, -1e-4, 3e-4};
    settings.threads = 1;
    const auto fast = make_lattice_boltzmann(settings), plain = make_plain_lattice_boltzmann(settings);
    for (auto* fluid : {fast.get(), plain.get()}) {
      disturb(*fluid);
      if (box.own_viscosity) fluid->set_viscosity(random_viscosity(settings.shape));
      if (!box.forced) continue;
      const auto forces = some_forces(settings.shape);
      fluid->add_force(forces.nodes, forces.force);
    }
    for (int step = 1; step <= 7; ++step) {  // an odd number: both turns come last once
      const double fast_speed = fast->step(), plain_speed = plain->step();
      EXPECT_NEAR(fast_speed, plain_speed,
                  20.0 * rounding(box.storage, step, largest(populations(*plain))) + eps);
      expect_same_flow(*fast, *plain, box.storage, step);
    }
    // The state of one is one for the other: the plain solver's goes on in the fast one.
    fast->restore(plain->state());
    fast->step();
    plain->step();
    expect_same_flow(*fast, *plain, box.storage, 1);
  }
}

std::vector<Box> boxes() {
  std::vector<Box> boxes;
  // Rows below, of and above one pack (8 and 16 numbers), and of some.
  const auto add = [&](int nx, Storage storage) {
    for (const int wall_axis : {-1, 0, 1, 2})
      for (const bool inertia : {true, false})
        for (const bool forced : {true, false})
          for (const bool own_viscosity : {true, false})
            boxes.push_back({{nx, 4, 5}, wall_axis, inertia, forced, own_viscosity, storage});
  };
  for (const int nx : {3, 8, 13, 19, 24}) add(nx, Storage::double_precision);
  for (const int nx : {3, 16, 23, 48}) add(nx, Storage::single_precision);
  for (const Storage storage : storages)
    for (const int wall_axis : {-1, 0, 1, 2})
      for (const GridShape& flat : {GridShape{9, 1, 1}, {5, 1, 3}, {7, 2, 1}, {17, 2, 2}})
        boxes.push_back({flat, wall_axis, true, true, true, storage});
  return boxes;
}
INSTANTIATE_TEST_SUITE_P(every, FluidBox, testing::ValuesIn(boxes()));

TEST(FluidDevelopedStart, is_the_same_in_both_solvers) {
  constexpr auto storage = Storage::double_precision;
  LatticeBoltzmannSettings settings;
  settings.shape = {9, 4, 6};
  settings.walls = moving_walls(2);
  settings.relaxation_time = 0.7;
  settings.body_force = {2e-4, -1e-4, 3e-4};
  settings.start = Start::developed;
  settings.threads = 1;
  const auto fast = make_lattice_boltzmann(settings), plain = make_plain_lattice_boltzmann(settings);
  EXPECT_EQ(populations(*fast), populations(*plain));
  for (int step = 1; step <= 3; ++step) {  // each turn, and the first of them on what the other has left
    fast->step();
    plain->step();
    expect_same_flow(*fast, *plain, storage, step);
  }
}

LatticeBoltzmannSettings rates(double relaxation_time, std::optional<double> magic_parameter) {
  LatticeBoltzmannSettings settings;
  settings.shape = {13, 5, 4};
  settings.walls = moving_walls(2);
  settings.relaxation_time = relaxation_time;
  settings.magic_parameter = magic_parameter;
  settings.body_force = {2e-4, -1e-4, 3e-4};
  settings.threads = 1;
  return settings;
}

// Lambda = (tau+ - 1/2)^2 makes tau- = tau+, the single-rate model. At these tau+ the sums for tau- are exact
// in binary, so there is no difference at all.
TEST(FluidRates, two_equal_relaxation_times_are_the_single_rate_model_bit_for_bit) {
  for (const double relaxation_time : {0.75, 1.0, 2.5}) {
    const double magic_parameter = (relaxation_time - 0.5) * (relaxation_time - 0.5);
    const auto two = make_lattice_boltzmann(rates(relaxation_time, magic_parameter));
    const auto single = make_lattice_boltzmann(rates(relaxation_time, std::nullopt));
    disturb(*two);
    disturb(*single);
    steps(*two, 21);
    steps(*single, 21);
    EXPECT_EQ(difference(two->state(), single->state()), "") << "tau+ " << relaxation_time;
  }
}

// At any other tau+, tau- is off by a few roundings, relative to (tau+ - 1/2) = 0.05 at the least: a relative
// change of 4 eps of w- = 1/tau-, which changes a population by 4 eps of it a step.
TEST(FluidRates, two_equal_relaxation_times_are_the_single_rate_model_to_rounding) {
  for (const double relaxation_time : {0.55, 0.6, 0.8, 1.3}) {
    const double magic_parameter = (relaxation_time - 0.5) * (relaxation_time - 0.5);
    const auto two = make_lattice_boltzmann(rates(relaxation_time, magic_parameter));
    const auto single = make_lattice_boltzmann(rates(relaxation_time, std::nullopt));
    disturb(*two);
    disturb(*single);
    steps(*two, 21);
    steps(*single, 21);
    const Numbers expected = populations(*single);
    EXPECT_LT(largest_difference(populations(*two), expected),
              rounding(Storage::double_precision, 21, largest(expected)));
  }
}

// The viscosity of the settings, set node by node, is the same flow; another one is not.
TEST(FluidRates, viscosity_per_node_means_the_same_as_the_relaxation_time) {
  const auto settings = rates(0.8, 3.0 / 16.0);
  for (const double viscosity : {0.1, 0.11}) {
    const auto uniform = make_lattice_boltzmann(settings), per_node = make_lattice_boltzmann(settings);
    disturb(*uniform);
    disturb(*per_node);
    per_node->set_viscosity(Numbers(settings.shape.size(), viscosity));
    steps(*uniform, 21);
    steps(*per_node, 21);
    const Numbers expected = populations(*uniform);
    const bool same = largest_difference(populations(*per_node), expected) <
                      rounding(Storage::double_precision, 21, largest(expected));
    EXPECT_EQ(same, viscosity == 0.1);
  }
}

}  // namespace
}  // namespace tanktread::fluid::test
