// Steps with implicit viscous forces: several capsules, threads, checkpoints, flows that deform nothing, and
// what stops them.
#include <gmock/gmock.h>

#include <algorithm>

#include "driver/observe/observables.hpp"
#include "driver/run/checkpoint.hpp"
#include "tests/integration/implicit_support.hpp"
#include "tests/integration/program.hpp"

namespace tanktread::driver {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ImplicitSystem, KeptVolumesAreAMoveOfTheirOwn) {
  const auto the_case = implicit_case({"coupler.implicit_tolerance=1e-12", "coupler.keep_volume=true"});
  auto system = make(the_case);
  for (int k = 0; k < 3; ++k) {
    const auto step = advance_and_look(system, the_case);
    EXPECT_LT(step.residual, 1e-12 * step.right_side + step.rounding) << "step " << k;
  }
}

TEST(ImplicitSystem, SeveralCapsulesAreSolvedForTogether) {
  const auto the_case = implicit_case({"coupler.implicit_tolerance=1e-12"}, implicit_capsules);
  auto system = make(the_case);
  EXPECT_NE(system.membranes[0].implicit_viscosity(), nullptr);
  EXPECT_EQ(system.membranes[1].implicit_viscosity(), nullptr);
  EXPECT_NE(system.membranes[2].implicit_viscosity(), nullptr);
  for (int k = 0; k < 4; ++k) {
    const auto step = advance_and_look(system, the_case);
    EXPECT_LT(step.residual, 1e-12 * step.right_side + step.rounding) << "step " << k;
    EXPECT_EQ(step.viscous_force[1].cwiseAbs().maxCoeff(), 0) << "the elastic one has none";
    for (const int capsule : {0, 2}) EXPECT_GT(step.viscous_force[capsule].norm(), 1e-4);
    // A capsule's forces move the others: what it is without is what each would be alone.
    EXPECT_GT((step.velocity[1] - step.free_velocity[1]).norm(), 1e-8);
  }
}

// Sums over capsules come in another order then, which rounds them otherwise; what is solved for differs by
// the tolerance. Three steps of it: below ten tolerances of the stress.
TEST(ImplicitSystem, TheOrderOfCapsulesIsOfNoImportance) {
  const auto the_case = implicit_case({"coupler.implicit_tolerance=1e-12"}, implicit_capsules);
  auto turned_case = the_case;
  std::ranges::reverse(turned_case.capsules);
  auto system = make(the_case), turned = make(turned_case);
  for (int k = 0; k < 3; ++k) {
    advance(system);
    advance(turned);
  }
  for (const int capsule : {0, 2}) {
    const auto &one = system.membranes[capsule].implicit_viscosity()->stress(),
               &other = turned.membranes[2 - capsule].implicit_viscosity()->stress();
    EXPECT_LT((one - other).norm(), 1e-11 * one.norm() + 1e-12) << one.norm();
  }
  EXPECT_LT((system.membranes[1].positions() - turned.membranes[1].positions()).norm(), 1e-11);
}

TEST(ImplicitSystem, DoesNotDependOnTheNumberOfThreads) {
  std::vector<System> systems;
  for (const std::string threads : {"1", "2", "3"})
    systems.push_back(make(implicit_case({"run.threads=" + threads}, implicit_capsules)));
  for (int k = 0; k < 4; ++k) {
    for (auto& system : systems) advance(system);
    for (const auto& system : systems) {
      for (std::size_t capsule = 0; capsule < 3; ++capsule) {
        EXPECT_EQ(system.node_force[capsule], systems[0].node_force[capsule]);
        EXPECT_EQ(system.membranes[capsule].positions(), systems[0].membranes[capsule].positions());
        EXPECT_EQ(system.membranes[capsule].state().history, systems[0].membranes[capsule].state().history);
      }
      EXPECT_EQ(system.viscous_iterations, systems[0].viscous_iterations);
    }
  }
}

TEST(ImplicitSystem, ACheckpointGoesOnBitForBit) {
  const auto the_case = implicit_case({}, implicit_capsules);
  auto system = make(the_case);
  for (int k = 0; k < 5; ++k) advance(system);
  const tanktread::testing::TemporaryDirectory directory;
  write_checkpoint(
      system.step, [&](const auto& folder) { write_state(folder, system, the_case); }, {}, directory.path());
  auto other = make(the_case);
  restore(other, read_checkpoint(find_checkpoint(directory.path(), std::nullopt)).state);
  for (int k = 0; k < 4; ++k) {
    advance(system);
    advance(other);
    EXPECT_EQ(system.viscous_iterations, other.viscous_iterations);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(system.node_force[k], other.node_force[k]);
    EXPECT_EQ(system.membranes[k].positions(), other.membranes[k].positions());
    EXPECT_EQ(system.membranes[k].state().history, other.membranes[k].state().history);
    EXPECT_TRUE(system.membranes[k].element_fields().viscous_stress ==
                other.membranes[k].element_fields().viscous_stress);
  }
  EXPECT_EQ(system.fluid->state().arrays[0].values, other.fluid->state().arrays[0].values);
}

// A uniform flow deforms nothing. The sphere is its stress-free shape, so that elastic forces are rounding as
// well.
TEST(ImplicitSystem, AUniformFlowMeetsNoViscousForce) {
  const auto the_case = implicit_case({"flow.body_force=[2e-5, -1e-5, 3e-5]"}, R"([flow]
kind = "periodic"
box = [14, 14, 14]
shear_rate = 2e-3
[[capsule]]
radius = 4.0
position = [7.0, 7.0, 7.0]
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
viscous = { scheme = "implicit", boussinesq_shear = 5.0, boussinesq_dilatational = 3.0 }
)");
  auto system = make(the_case);
  for (int k = 0; k < 20; ++k) {
    const auto step = advance_and_look(system, the_case);
    const double speed = step.velocity[0].colwise().norm().maxCoeff();
    EXPECT_GT(speed, 3e-5 * k);
    // Velocities are rounded as those of advance_and_look(), B u is zero but for that; and B^T as large as B.
    const auto& viscosity = *system.membranes[0].implicit_viscosity();
    EXPECT_LT(viscosity.stress().norm(), step.rounding);
    EXPECT_LT(step.viscous_force[0].norm(), largest_rates(viscosity) * step.rounding);
  }
}

TEST(ImplicitSystem, WhereNothingMovesThereIsNothingToIterate) {
  auto system = make(implicit_case());
  const auto nodes = system.coupler->grid_node_list();
  const GridVectors still{nodes, std::vector<double>(3 * nodes->size()),
                          std::vector<double>(nodes->size(), 0.5)};
  auto force = zero_like(system.node_force);
  EXPECT_EQ(add_implicit_forces(system.membranes, *system.coupler, system.corrections, still, system.implicit,
                                force),
            0);
  EXPECT_EQ(force[0].cwiseAbs().maxCoeff(), 0);
}

TEST(ImplicitSystem, TheIterationsOfAStepAreCounted) {
  const auto the_case = implicit_case({"coupler.implicit_tolerance=1e-6"});
  auto system = make(the_case);
  EXPECT_EQ(observe(system, the_case)[0].viscous_iterations, 0);
  advance(system);
  const int first = system.viscous_iterations;
  EXPECT_GT(first, 3);
  EXPECT_EQ(observe(system, the_case)[0].viscous_iterations, first);
  // From two stresses the next is guessed well: fewer do.
  for (int k = 0; k < 10; ++k) advance(system);
  EXPECT_LT(system.viscous_iterations, first);
  const auto elastic = implicit_case({"membrane.viscous.scheme=none", "membrane.viscous.boussinesq_shear=0"});
  auto other = make(elastic);
  advance(other);
  EXPECT_EQ(observe(other, elastic)[0].viscous_iterations, std::nullopt);
}

// A soft spring: the memory is a thousand times the rates, and a tolerance of it would let all rates pass.
// The error of a step is 1e-3 of its rates; what is remembered sums up at most as much of the stress.
TEST(ImplicitSystem, ALongMemoryIsNoExcuse) {
  const std::vector<std::string> soft = {"membrane.viscous.spring_stiffness=2",
                                         "membrane.viscous.spring_stiffness_dilatational=2"};
  auto exact_case = soft;
  exact_case.push_back("coupler.implicit_tolerance=1e-10");
  auto loose = make(implicit_case(soft)), exact = make(implicit_case(exact_case));
  for (int k = 0; k < 100; ++k) advance(loose), advance(exact);
  const auto& found = std::as_const(loose.membranes[0]).implicit_viscosity()->stress();
  const auto& expected = std::as_const(exact.membranes[0]).implicit_viscosity()->stress();
  EXPECT_LT((found - expected).norm(), 2e-3 * expected.norm());
}

TEST(ImplicitSystem, StopsWhereTheEquationsAreNotSolved) {
  auto system = make(implicit_case({"coupler.implicit_iterations=2", "coupler.implicit_tolerance=1e-9"}));
  try {
    advance(system);
    ADD_FAILURE() << "went on";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("step 1: the implicit viscous forces were not found: after 2 iterations"),
                      HasSubstr("above coupler.implicit_tolerance = 1e-09"),
                      HasSubstr("coupler.implicit_iterations")));
  }
}

// At once, and not after all the iterations that a case allows.
TEST(ImplicitSystem, AFreeVelocityThatIsNoNumberIsRefused) {
  auto system = make(implicit_case({"coupler.implicit_iterations=1000000"}));
  const auto nodes = system.coupler->grid_node_list();
  GridVectors free{nodes, std::vector<double>(3 * nodes->size()), std::vector<double>(nodes->size(), 0.5)};
  free.values[free.values.size() / 2] = std::numeric_limits<double>::quiet_NaN();
  auto force = zero_like(system.node_force);
  try {
    add_implicit_forces(system.membranes, *system.coupler, system.corrections, free, system.implicit, force);
    FAIL() << "taken";
  } catch (const NotConverged& error) {
    EXPECT_THAT(error.what(), HasSubstr("are not finite"));
  }
}

TEST(ImplicitSystem, NodesWithoutAFreeVelocityAreNamed) {
  auto system = make(implicit_case());
  auto free = free_velocity(*system.fluid, system.coupler->grid_node_list());
  auto nodes = *free.nodes;
  const auto missing = nodes[5];
  nodes.erase(nodes.begin() + 5);
  free = free_velocity(*system.fluid, std::make_shared<const std::vector<std::int64_t>>(nodes));
  auto force = zero_like(system.node_force);
  try {
    add_implicit_forces(system.membranes, *system.coupler, system.corrections, free, system.implicit, force);
    ADD_FAILURE() << "taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no free velocity on grid node " + std::to_string(missing)));
  }
}

}  // namespace
}  // namespace tanktread::driver
