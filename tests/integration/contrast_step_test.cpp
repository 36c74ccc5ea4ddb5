// Steps of capsules with another fluid inside: what moves, and how.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "driver/observe/observables.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/step.hpp"

namespace tanktread::driver::contrast_step_test {
namespace {

constexpr const char* capsule_in_shear = R"([flow]
box = [22, 20, 24]
wall_speed = 0.03
start = "developed"
inertia = false
[[capsule]]
radius = 5.0
position = [11.0, 10.0, 12.0]
mesh = { level = 2 }
[membrane]
capillary_number = 0.2
[run]
threads = 1
)";

/// A box without walls, the fluid at rest.
constexpr const char* capsules_at_rest = R"([flow]
kind = "periodic"
box = [22, 14, 14]
shear_rate = 1e-3
inertia = false
speed_limit = 0.1
[[capsule]]
radius = 3.5
position = [5.6, 7.1, 6.8]
viscosity_ratio = 5.0
mesh = { level = 1 }
[[capsule]]
radius = 3.0
position = [16.3, 6.9, 7.2]
viscosity_ratio = 0.2
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
[run]
threads = 1
)";

System make(const Case& the_case) {
  const auto p = parameters(the_case);
  return make_system(the_case, p, membrane_shapes(the_case));
}

Case parse(const char* text, const std::vector<std::string>& assignments) {
  return parse_case(text, "contrast.toml", "/", assignments);
}

/// Velocities of all grid nodes.
std::vector<double> velocity_of(const System& system) {
  std::vector<double> density(static_cast<std::size_t>(system.fluid->shape().size())),
      velocity(3 * density.size());
  system.fluid->moments(density, velocity);
  return velocity;
}

// With and without the correction, and for no capsule of the viscosity outside.
TEST(ContrastStep, TheShearDipoleIsThatOfTheKeyAndOfTheContrast) {
  for (const std::string correction : {"true", "false"}) {
    const auto after = [&](const std::string& dipole, const std::string& ratio) {
      auto system =
          make(parse(capsule_in_shear, {"coupler.tangential_correction=" + correction,
                                        "coupler.shear_dipole=" + dipole, "flow.viscosity_ratio=" + ratio}));
      for (int step = 0; step < 20; ++step) advance(system);
      return system.membranes[0].positions();
    };
    // The dipole moves a node by a part of the shear over a grid step, here 0.003 a step.
    const double moved = (after("true", "5") - after("false", "5")).cwiseAbs().maxCoeff();
    EXPECT_GT(moved, 1e-4) << correction;
    EXPECT_LT(moved, 20 * 0.003) << correction;
    EXPECT_EQ(after("true", "1"), after("false", "1")) << correction;
  }
}

// Six grid steps lie between their kernels, on both sides, and nothing travels faster than one a step.
TEST(ContrastStep, ANeighbourOfTheViscosityOutsideHasNoDipole) {
  constexpr int n_steps = 4;
  const std::string pair = std::string(capsule_in_shear) + R"([[capsule]]
radius = 5.0
position = [33.0, 10.0, 12.0]
viscosity_ratio = 5.0
mesh = { level = 2 }
)";
  for (const std::string correction : {"true", "false"}) {
    const auto after = [&](const std::string& dipole) {
      auto system = make(parse(pair.c_str(), {"flow.box=[44, 20, 24]", "coupler.shear_dipole=" + dipole,
                                              "coupler.tangential_correction=" + correction}));
      for (int step = 0; step < n_steps; ++step) advance(system);
      return system;
    };
    const auto with = after("true"), without = after("false");
    EXPECT_EQ(with.membranes[0].positions(), without.membranes[0].positions()) << correction;
    EXPECT_NE(with.membranes[1].positions(), without.membranes[1].positions()) << correction;
  }
}

TEST(ContrastStep, EachCapsuleHasTheDipoleOfItsOwnViscosity) {
  const auto lengths_of = [](const std::vector<std::string>& assignments) {
    return make(parse(capsules_at_rest, assignments)).corrections.dipole_lengths;
  };
  const auto mixed = lengths_of({}),
             same = lengths_of({"flow.viscosity_ratio=0.2", "capsule.0.viscosity_ratio=0.2"});
  ASSERT_EQ(mixed.size(), 2U);
  ASSERT_EQ(same.size(), 2U);
  EXPECT_LT(mixed[0], 0);  // inwards, where the viscosity is greater
  EXPECT_GT(mixed[1], 0);
  EXPECT_EQ(same[0], mixed[1]);
  EXPECT_EQ(same[1], mixed[1]);
}

TEST(ContrastStep, NothingMovesInAFluidAtRest) {
  auto system = make(parse(capsules_at_rest, {}));
  const auto start = system.membranes[0].positions(), other = system.membranes[1].positions();
  for (int step = 0; step < 20; ++step) advance(system);
  // Forces of membranes without strain are rounding: eps times a modulus below 1.
  for (const double velocity : velocity_of(system)) ASSERT_LT(std::abs(velocity), 1e-15);
  EXPECT_LT((system.membranes[0].positions() - start).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((system.membranes[1].positions() - other).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_TRUE(system.inside->changes().empty());
}

// A uniform force sets the whole fluid in the same motion, whatever its viscosities: u = F t after t
// steps. Capsules go with it as they are, and nodes come into them and go out.
TEST(ContrastStep, AUniformMotionKnowsNoViscosity) {
  constexpr double force = 2e-4;
  constexpr int n_steps = 120;
  auto system = make(parse(capsules_at_rest, {"flow.body_force=[2e-4, 0, 0]"}));
  const auto start = system.membranes[0].positions();
  std::size_t n_changes = 0;
  for (int step = 0; step < n_steps; ++step) {
    advance(system);
    n_changes += system.inside->changes().size();
  }
  // By 1.4 grid steps: nearly all nodes of the fronts and backs, some 2 pi (3.5^2 + 3^2) a grid step.
  EXPECT_GT(n_changes, 100U);
  const auto velocity = velocity_of(system);
  // Rounding of some 20 populations below 0.02 a step, eps each, as a walk of 120 steps at the most in one
  // direction: 1e-14; so moved, membranes are strained by rounding too.
  for (std::size_t k = 0; k < velocity.size(); ++k)
    ASSERT_NEAR(velocity[k], k % 3 == 0 ? force * n_steps : 0.0, 1e-13) << k;
  // Nodes move by the velocity before each step: F (0 + 1 + ... + n_steps - 1).
  const Eigen::Matrix3Xd moved = system.membranes[0].positions() - start;
  EXPECT_NEAR(moved.row(0).minCoeff(), force * n_steps * (n_steps - 1) / 2, 1e-11);
  EXPECT_NEAR(moved.row(0).maxCoeff(), force * n_steps * (n_steps - 1) / 2, 1e-11);
}

/// D of the capsule in shear after 0.25 shear times.
double deformation(const std::string& viscosity_ratio) {
  const auto the_case = parse(capsule_in_shear, {"flow.viscosity_ratio=" + viscosity_ratio});
  auto system = make(the_case);
  for (int step = 0; step < 100; ++step) advance(system);
  return observe(system, the_case)[0].deformation;
}

// A sphere of fluid without a membrane begins to deform at the rate dD/dt = g 5/(2 (2 lambda + 3)) (G. I.
// Taylor, Proc. R. Soc. A 146, 1934, without tension). Here the membrane holds back the faster one more, and
// the fluid inside needs a^2/(lambda nu), up to a shear time, to get that far from the developed flow that
// all begin with. So ratios of D are between these and 1.
TEST(ContrastStep, AThickFluidDeformsLater) {
  const double thin = deformation("0.5"), same = deformation("1"), thick = deformation("5");
  EXPECT_GT(same, 0.05);
  EXPECT_LT(thick / same, 0.8);
  EXPECT_GT(thick / same, 5.0 / 13);
  EXPECT_GT(thin / same, 1.02);
  EXPECT_LT(thin / same, 5.0 / 4);
}

TEST(ContrastStep, ARatioOfOneIsNoneAndTheStateHasTheOthers) {
  const auto the_case =
      parse(capsules_at_rest, {"capsule.0.viscosity_ratio=1", "capsule.1.viscosity_ratio=1"});
  EXPECT_FALSE(has_contrast(the_case));
  EXPECT_EQ(make(the_case).inside, nullptr);
  const auto contrast = parse(capsules_at_rest, {"capsule.0.viscosity_ratio=1"});
  EXPECT_TRUE(has_contrast(contrast));
  const auto system = make(contrast);
  ASSERT_NE(system.inside, nullptr);
  const auto state = system.fluid->state();
  const auto array = std::ranges::find(state.arrays, "viscosity", &fluid::StateArray::name);
  ASSERT_NE(array, state.arrays.end());
  const double nu = 1.0 / 6;
  const auto marks = system.inside->marks();
  for (std::size_t node = 0; node < marks.size(); ++node)
    ASSERT_DOUBLE_EQ(array->values[node], marks[node] == 2 ? 0.2 * nu : nu) << node;
}

}  // namespace
}  // namespace tanktread::driver::contrast_step_test
