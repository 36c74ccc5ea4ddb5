// Implicit viscous forces in the coupled step: that they are those of the velocity which the step leads to,
// what they dissipate, and their equations.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/integration/implicit_support.hpp"

namespace tanktread::driver {
namespace {

/// Inertia; coupling: the default, whose correction along the membrane depends on the force itself, the same
/// without it, and a kernel that never has it; where rates are taken.
using Setting = std::tuple<bool, std::string, std::string>;

class ImplicitStep : public ::testing::TestWithParam<Setting> {
 protected:
  static std::vector<std::string> with(std::vector<std::string> more) {
    const auto& [inertia, coupling, rates] = GetParam();
    more.push_back(std::string("flow.inertia=") + (inertia ? "true" : "false"));
    if (coupling == "plain") more.emplace_back("coupler.tangential_correction=false");
    if (coupling == "cosine4") more.emplace_back("coupler.kernel=cosine4");
    more.push_back("membrane.viscous.strain_rates=" + rates);
    return more;
  }
};
INSTANTIATE_TEST_SUITE_P(Every, ImplicitStep,
                         ::testing::Combine(::testing::Bool(),
                                            ::testing::Values("corrected", "plain", "cosine4"),
                                            ::testing::Values("nodes", "elements")),
                         [](const auto& tested) {
                           return std::string(std::get<0>(tested.param) ? "inertia_" : "no_inertia_") +
                                  std::get<1>(tested.param) + "_" + std::get<2>(tested.param);
                         });

// The residual of conjugate gradients is what is asked for, relative to the right side.
TEST_P(ImplicitStep, TheStressIsOfTheVelocityThatTheNextStepFinds) {
  for (const std::string tolerance : {"1e-12", "1e-4"}) {
    const auto the_case = implicit_case(with({"coupler.implicit_tolerance=" + tolerance}));
    auto system = make(the_case);
    double largest = 0;
    for (int k = 0; k < 5; ++k) {  // the lattice turns its populations over in every second one
      const auto step = advance_and_look(system, the_case);
      ASSERT_GT(step.right_side, 0.01);
      ASSERT_LT(step.rounding, 1e-8 * step.right_side);
      EXPECT_LT(step.residual, std::stod(tolerance) * step.right_side + step.rounding)
          << "step " << k << ", right side " << step.right_side;
      largest = std::max(largest, step.residual / step.right_side);
      // It is not that of the velocity without it: a good part of the rates is stopped.
      EXPECT_LT(system.membranes[0].implicit_viscosity()->stress().norm(), 0.95 * step.right_side);
    }
    // No more is done than what is asked for.
    if (tolerance == "1e-4") {
      EXPECT_GT(largest, 1e-8);
    }
  }
}

// F_v.u = -s.B u, and s is B u but for the residual r: -|s|^2 + s.r.
TEST_P(ImplicitStep, TheForcesTakeThePowerThatTheMembraneDissipates) {
  const auto the_case = implicit_case(with({"coupler.implicit_tolerance=1e-12"}));
  auto system = make(the_case);
  for (int k = 0; k < 4; ++k) {
    const auto step = advance_and_look(system, the_case);
    const double stress = system.membranes[0].implicit_viscosity()->stress().norm();
    ASSERT_GT(stress, 0.001);
    // Forces and velocities of some hundred components round their product by less than 1000 eps.
    const double rounding =
        1000 * std::numeric_limits<double>::epsilon() * system.node_force[0].norm() * step.velocity[0].norm();
    EXPECT_NEAR(dot(step.viscous_force[0], step.velocity[0]), -stress * stress,
                stress * (1e-12 * step.right_side + step.rounding) + rounding)
        << "step " << k;
  }
}

TEST_P(ImplicitStep, ASpringKeepsItsMemory) {
  const auto the_case =
      implicit_case(with({"coupler.implicit_tolerance=1e-12", "membrane.viscous.spring_stiffness=20",
                          "membrane.viscous.spring_stiffness_dilatational=100"}));
  auto system = make(the_case);
  for (int k = 0; k < 5; ++k) {
    const auto step = advance_and_look(system, the_case);
    EXPECT_LT(step.residual, 1e-12 * step.right_side + step.rounding) << "step " << k;
  }
}

/// The viscous forces that follow from a free velocity of the grid and no other forces, and the nodes'
/// velocity without them.
struct Answer {
  NodeVectors force, free_velocity;
};
Answer answer(System& system, const GridVectors& free) {
  Answer result{zero_like(system.node_force), {}};
  result.free_velocity = interpolated_velocity(*system.coupler, free, system.node_force);
  std::vector<MembraneState> states;
  for (const auto& membrane : system.membranes) states.push_back(membrane.state());
  add_implicit_forces(system.membranes, *system.coupler, system.corrections, free, system.implicit,
                      result.force);
  for (std::size_t k = 0; k < states.size(); ++k) system.membranes[k].restore(states[k]);
  return result;
}

double dot(const NodeVectors& a, const NodeVectors& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].cwiseProduct(b[k]).sum();
  return sum;
}

double size_of_rates(const System& system, const NodeVectors& velocity) {
  double sum = 0;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const auto* viscosity = system.membranes[k].implicit_viscosity();
    if (viscosity != nullptr) sum += rates(*viscosity, velocity[k]).squaredNorm();
  }
  return std::sqrt(sum);
}

GridVectors random_flow(const System& system, unsigned seed, const std::vector<double>& mobility) {
  std::mt19937 random(seed);
  GridVectors free{system.coupler->grid_node_list(), {}, mobility};
  for (std::size_t k = 0; k < 3 * free.nodes->size(); ++k)
    free.values.push_back(random() / double(std::mt19937::max()) - 0.5);
  return free;
}

// F = -B^T A^-1 B u0 with A = 1 + theta + B M B^T of the state before any stress. A >= 1 in every direction,
// so that a residual of 1e-13 |B u0| changes s by no more, and F.v by 1e-13 |B u0| |B v|. Rounding within the
// iterations is of that size, too: allow ten times as much.
TEST_P(ImplicitStep, TheAnswerToAFlowIsLinearSymmetricAndTakesPower) {
  for (const char* text : {implicit_capsule, implicit_capsules}) {
    auto assignments = with({"coupler.implicit_tolerance=1e-13"});
    if (text == implicit_capsules) assignments.pop_back();  // two capsules have both forms of the rates
    auto system = make(implicit_case(assignments, text));
    // A fluid of uneven density: mobilities from 0.4 to 0.6.
    auto mobility = random_flow(system, 7, {}).values;
    mobility.resize(mobility.size() / 3);
    for (auto& of_node : mobility) of_node = 0.5 + 0.2 * of_node;
    const auto one = random_flow(system, 1, mobility), two = random_flow(system, 2, mobility);
    auto both = one;
    for (std::size_t k = 0; k < both.values.size(); ++k)
      both.values[k] = 3 * one.values[k] - 2 * two.values[k];
    const auto of_one = answer(system, one), of_two = answer(system, two), of_both = answer(system, both);
    const double size_one = size_of_rates(system, of_one.free_velocity),
                 size_two = size_of_rates(system, of_two.free_velocity);
    ASSERT_GT(size_one, 0.1);

    EXPECT_NEAR(dot(of_one.force, of_two.free_velocity), dot(of_two.force, of_one.free_velocity),
                10 * 2e-13 * size_one * size_two);
    EXPECT_NEAR(dot(of_both.force, of_two.free_velocity),
                3 * dot(of_one.force, of_two.free_velocity) - 2 * dot(of_two.force, of_two.free_velocity),
                10 * 1e-13 * (2 * (3 * size_one + 2 * size_two)) * size_two);
    // Positive: between 0 and |B u0|^2, from above since B M B^T is not zero, from below since it is not
    // infinite.
    for (const auto& [of, size] : {std::pair(of_one, size_one), std::pair(of_two, size_two)}) {
      EXPECT_LT(dot(of.force, of.free_velocity), -1e-3 * size * size);
      EXPECT_GT(dot(of.force, of.free_velocity), -0.99 * size * size);
    }
  }
}

}  // namespace
}  // namespace tanktread::driver
