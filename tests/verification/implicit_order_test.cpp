// Orders of the implicit viscosity: in the stiffness of a spring, against the explicit scheme, in the time
// step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "driver/observe/observables.hpp"
#include "tests/integration/implicit_support.hpp"

namespace tanktread::driver {
namespace {

/// Rates of the elements, as an explicit scheme has them; tolerances that no difference below depends on.
std::vector<std::string> implicit(std::vector<std::string> more = {}) {
  more.insert(more.end(), {"membrane.viscous.scheme=implicit", "membrane.viscous.strain_rates=elements",
                           "coupler.implicit_tolerance=1e-9"});
  return more;
}
std::vector<std::string> explicit_scheme(std::vector<std::string> more) {
  more.emplace_back("membrane.viscous.scheme=fd");
  return more;
}
std::string spring(double kappa) {
  return fmt::format("membrane.viscous.spring_stiffness={}", kappa);
}
/// The fluid that keeps the Reynolds number where the wall speed is `part` of 0.02: nu goes with tau+ - 1/2.
std::string same_reynolds_number(double part) {
  return fmt::format("flow.relaxation_time={}", 0.5 + 0.5 * part);
}

/// D at shear time 0.25, which every wall speed below reaches in whole steps: 100 of them at 0.02.
double deformation(std::vector<std::string> assignments, double part_of_speed = 1) {
  constexpr const char* text = R"([flow]
box = [16, 14, 16]
start = "developed"
inertia = false
[[capsule]]
radius = 4.0
position = [8.0, 7.0, 8.0]
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
viscous = { boussinesq_shear = 2.0, boussinesq_dilatational = 1.0 }
)";
  assignments.push_back(fmt::format("flow.wall_speed={}", 0.02 * part_of_speed));
  const auto the_case = implicit_case(assignments, text);
  auto system = make(the_case);
  const auto steps = std::lround(0.25 / system.shear_rate);
  while (system.step < steps) advance(system);
  return observe(system, the_case)[0].deformation;
}

// A Maxwell element under a rate that changes slowly against its relaxation time, 4/kappa shear times, lags
// behind the dashpot by that time: D differs by c/kappa + O(1/kappa^2). At kappa = 50 that is 0.08 of the
// 0.25 shear times, and the first order stands out.
TEST(ImplicitOrder, ASpringIsOfFirstOrderInItsSoftness) {
  const double without = deformation(implicit());
  std::vector<double> differences;
  for (const double kappa : {50.0, 100.0, 200.0, 400.0}) {
    differences.push_back(deformation(implicit({spring(kappa)})) - without);
  }
  for (std::size_t k = 1; k < differences.size(); ++k) {
    const double ratio = differences[k - 1] / differences[k];
    EXPECT_GT(ratio, 1.9);
    EXPECT_LT(ratio, 2.1);
  }
  // A softer membrane deforms more: the spring gives way.
  EXPECT_GT(differences[0], 0.005);
}

// The explicit scheme takes the strain of a step that is done for the force of the next, so that it is
// another time step's error away, below c/kappa by far at an eighth of the speed.
TEST(ImplicitOrder, TheExplicitSchemeTendsToItAsItsSpringStiffens) {
  constexpr double slow = 0.125;
  const std::string fluid = same_reynolds_number(slow);
  const double without = deformation(implicit({fluid}), slow);
  std::vector<double> differences;
  for (const double kappa : {50.0, 100.0, 200.0}) {
    differences.push_back(deformation(explicit_scheme({fluid, spring(kappa)}), slow) - without);
  }
  for (std::size_t k = 1; k < differences.size(); ++k) {
    const double ratio = differences[k - 1] / differences[k];
    EXPECT_GT(ratio, 1.9);
    EXPECT_LT(ratio, 2.15);
  }
}

// With the same spring both are a Maxwell element, each of first order in the time step. Not quite the same
// one: the one follows the strain of the stress-free shape, the other numbers along edges, times roots of
// present areas. Such ways to follow a stress differ by relaxation time times stress times rate, which is of
// the first order in 1/kappa, but for rates that hardly change it is below a hundredth of what the spring
// does at all (3.5e-3 in D at kappa = 100; measured: 8e-6).
TEST(ImplicitOrder, WithTheSameSpringBothSchemesAreTheSameElement) {
  std::vector<double> differences;
  for (const double part : {1.0, 0.5, 0.25}) {
    const std::vector<std::string> common = {same_reynolds_number(part), spring(100)};
    differences.push_back(deformation(explicit_scheme(common), part) - deformation(implicit(common), part));
  }
  const double first = differences[0] - differences[1], second = differences[1] - differences[2];
  EXPECT_GT(first / second, 1.9);
  EXPECT_LT(first / second, 2.1);
  EXPECT_LT(std::abs(differences[2] - second), 3.5e-5) << "in the limit";
}

std::vector<std::string> by_nodes(std::vector<std::string> more) {
  more.insert(more.end(), {"membrane.viscous.scheme=implicit", "coupler.implicit_tolerance=1e-9"});
  return more;
}

// The time step alone: speed and viscosity of the fluid go down together, and the Reynolds number stays.
// Positions move by the velocity of the step before, and the force lags its positions by half a step at most:
// first order. The fluid's compressibility goes with the square of the speed: D = D0 + a dt + b dt^2. Without
// the first, 2 D(dt/2) - D(dt) = D0 - b dt^2/2, whose differences fall to a quarter.
TEST(ImplicitOrder, IsOfFirstOrderInTheTimeStep) {
  std::vector<double> d, second;
  for (const double part : {1.0, 0.5, 0.25, 0.125, 0.0625}) {
    d.push_back(deformation(by_nodes({same_reynolds_number(part)}), part));
  }
  for (std::size_t k = 1; k < d.size(); ++k) second.push_back(2 * d[k] - d[k - 1]);
  for (std::size_t k = 2; k < second.size(); ++k) {
    const double ratio = (second[k - 1] - second[k - 2]) / (second[k] - second[k - 1]);
    EXPECT_GT(ratio, 3.8);
    EXPECT_LT(ratio, 4.2);
  }
  // The first order is there: at the last step it is several times the second.
  EXPECT_GT(std::abs(d.back() - second.back()), 3 * std::abs(second[3] - second[2]));
}

// At one viscosity of the fluid the Reynolds number goes with the speed, as a user's smaller wall_speed has
// it. It is felt in the first order too, and more: without inertia the fluid still takes its time to follow.
TEST(ImplicitOrder, ASmallerSpeedAtTheSameFluidIsOfFirstOrderToo) {
  std::vector<double> d;
  for (const double part : {1.0, 0.5, 0.25, 0.125}) d.push_back(deformation(by_nodes({}), part));
  for (std::size_t k = 2; k < d.size(); ++k) {
    const double ratio = (d[k - 1] - d[k - 2]) / (d[k] - d[k - 1]);
    EXPECT_GT(ratio, 1.8);
    EXPECT_LT(ratio, 2.1);
  }
}

}  // namespace
}  // namespace tanktread::driver
