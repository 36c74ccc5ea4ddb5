// A flow that goes wrong stops the step and says what, where and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

LatticeBoltzmannSettings box(bool inertia = true, int threads = 1) {
  LatticeBoltzmannSettings settings;
  settings.shape = {19, 5, 4};
  settings.inertia = inertia;
  settings.threads = threads;
  return settings;
}

std::string breakdown_of(Fluid& fluid) {
  try {
    fluid.step();
  } catch (const Breakdown& error) {
    return error.what();
  }
  ADD_FAILURE() << "the step went on";
  return "";
}

/// The node's name in a message.
std::string name(int x, int y, int z) {
  return "(" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + ")";
}

// Whole packs (x < 16), the lanes of the pack at the row's end, both turns, with and without inertia.
TEST(FluidBreakdown, names_the_node_and_step_of_a_velocity_that_is_not_finite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const bool inertia : {true, false}) {
      for (int x = 0; x < 19; ++x) {
        const auto fluid = make_lattice_boltzmann(box(inertia));
        const int n_before = 2 + x % 2;
        steps(*fluid, n_before);
        fluid->add_force(std::vector{fluid->shape().index(x, 3, 2)}, Numbers{0, bad, 0});
        EXPECT_THAT(breakdown_of(*fluid), AllOf(HasSubstr("step " + std::to_string(n_before + 1) + ":"),
                                                HasSubstr("node " + name(x, 3, 2)), HasSubstr("finite")));
      }
    }
  }
}

TEST(FluidBreakdown, names_the_node_step_and_limit_of_a_speed_too_high) {
  for (const bool inertia : {true, false}) {
    for (int x = 0; x < 19; ++x) {
      const auto fluid = make_lattice_boltzmann(box(inertia));
      fluid->step();
      fluid->add_force(std::vector{fluid->shape().index(x, 1, 3)}, Numbers{0, 0, 0.7});  // speed 0.35
      EXPECT_THAT(breakdown_of(*fluid), AllOf(HasSubstr("step 2:"), HasSubstr("node " + name(x, 1, 3)),
                                              HasSubstr("0.35"), HasSubstr("speed_limit, 0.3")));
    }
  }
}

// Just below the limit the step goes on and returns that speed: F/2 on a node at rest.
TEST(FluidBreakdown, leaves_a_speed_below_the_limit_alone) {
  for (auto make : {make_lattice_boltzmann, make_plain_lattice_boltzmann}) {
    auto settings = box();
    settings.speed_limit = 0.05;
    const auto fluid = make(settings);
    const std::vector node = {fluid->shape().index(18, 4, 3)};
    fluid->add_force(node, Numbers{0.0999, 0, 0});
    EXPECT_NEAR(fluid->step(), 0.0999 / 2.0, 4.0 * eps);
    const auto too_fast = make(settings);
    too_fast->add_force(node, Numbers{0.1001, 0, 0});
    EXPECT_THROW(too_fast->step(), Breakdown);
  }
}

// Of several nodes that go wrong in one step, the first is named, whichever thread meets it.
TEST(FluidBreakdown, names_the_same_node_for_any_number_of_threads) {
  for (const int threads : {1, 2, 3, 4}) {
    const auto fluid = make_lattice_boltzmann(box(true, threads));
    const auto& shape = fluid->shape();
    fluid->add_force(std::vector{shape.index(2, 4, 3), shape.index(17, 2, 1), shape.index(18, 2, 1)},
                     Numbers{1, 0, 0, 0, 1, 0, 0, 0, 1});
    EXPECT_THAT(breakdown_of(*fluid), HasSubstr("node " + name(17, 2, 1)));
  }
}

TEST(FluidBreakdown, comes_from_a_fluid_that_blows_up_by_itself) {
  auto settings = box();
  settings.relaxation_time = 0.5001;  // hardly any viscosity
  settings.body_force = {0.02, 0, 0};
  const auto fluid = make_lattice_boltzmann(settings);
  disturb(*fluid);
  EXPECT_THROW(steps(*fluid, 100), Breakdown);
}

TEST(FluidBreakdown, of_the_plain_solver_names_node_and_step) {
  const auto fluid = make_plain_lattice_boltzmann(box());
  fluid->step();
  fluid->add_force(std::vector{fluid->shape().index(7, 3, 2)},
                   Numbers{0, std::numeric_limits<double>::quiet_NaN(), 0});
  EXPECT_THAT(breakdown_of(*fluid), AllOf(HasSubstr("step 2:"), HasSubstr("node " + name(7, 3, 2))));
}

}  // namespace
}  // namespace tanktread::fluid::test
