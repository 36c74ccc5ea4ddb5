// The study of two liquids between walls: its exact flow, what theory says of each viscosity of the nodes,
// and the velocity of the sheet.
#include "driver/study/study_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupler/two_fluids.hpp"
#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

constexpr double largest_speed = 0.01;  // of the exact flows

/// What a flow that is called steady may be away from the steady one: less than it still changes while that
/// falls by 1/e, and as much again for rounding and for modes that fall together.
double distance_from_steady(const LayersStudy& study) {
  return 2 * study.steadiness * largest_speed;
}

TEST(TwoLayers, HaveOneStressAndTheWallsOfTheirFlow) {
  for (const double force : {0.0, 2e-5, -1e-4}) {
    const TwoLayers layers{.height = 10,
                           .sheet = 3.3,
                           .viscosity_below = 0.7,
                           .viscosity_above = 0.2,
                           .wall_velocity = 0.05,
                           .force = force};
    EXPECT_EQ(layers.velocity(0), 0);
    EXPECT_NEAR(layers.velocity(10), 0.05, 1e-15);
    // Parabolas have exact central differences: mu u'' = -F in each liquid. Rounding: eps 0.05/0.25^2.
    const double d = 0.25;
    for (const double z : {1.0, 2.9, 3.7, 8.0}) {
      const double mu = z < 3.3 ? 0.7 : 0.2;
      EXPECT_NEAR(mu * (layers.velocity(z - d) - 2 * layers.velocity(z) + layers.velocity(z + d)) / (d * d),
                  -force, 1e-15);
    }
    // One-sided differences that are exact for parabolas: mu u' is the same on both sides of the sheet.
    const auto slope = [&](double step) {
      const double u = layers.velocity(3.3), u1 = layers.velocity(3.3 + step),
                   u2 = layers.velocity(3.3 + 2 * step);
      return (4 * u1 - u2 - 3 * u) / (2 * step);
    };
    EXPECT_NEAR(0.7 * slope(-d), 0.2 * slope(d), 1e-15);
    double largest = 0;
    for (int k = 0; k <= 10000; ++k) largest = std::max(largest, std::abs(layers.velocity(1e-3 * k)));
    EXPECT_NEAR(layers.largest_speed(), largest,
                1e-7);  // by 1e-3 from the top of a parabola of slope 2e-3 a step
  }
}

TEST(LayersStudy, PutsTheSheetAtMidpointsOfAGridStep) {
  EXPECT_EQ(sheet_heights({.height = 16, .sheet = 0.5, .n_places = 4}),
            (std::vector{7.625, 7.875, 8.125, 8.375}));
}

TEST(LayersStudy, GivesANodeTheViscosityOfItsForm) {
  // tau+ = 2: 1/2 of the less viscous liquid, and 4 times that below. The sheet leaves a quarter of the cell
  // of node 3 below it.
  const LayersStudy study{.viscosity_ratio = 4, .height = 6, .relaxation_time = 2};
  const auto with = [&](NodeViscosity form, double sheet) {
    auto changed = study;
    changed.form = form;
    return node_viscosities(changed, sheet);
  };
  EXPECT_EQ(with(NodeViscosity::sharp, 3.25), (std::vector{2.0, 2.0, 2.0, 0.5, 0.5, 0.5}));
  EXPECT_EQ(with(NodeViscosity::sharp, 3.75), (std::vector{2.0, 2.0, 2.0, 2.0, 0.5, 0.5}));
  EXPECT_NEAR(with(NodeViscosity::harmonic, 3.25)[3], 1 / (0.25 / 2.0 + 0.75 / 0.5), 1e-15);
  EXPECT_NEAR(with(NodeViscosity::arithmetic, 3.25)[3], 0.25 * 2.0 + 0.75 * 0.5, 1e-15);
  for (const auto form : {NodeViscosity::harmonic, NodeViscosity::arithmetic})
    EXPECT_EQ(with(form, 3.0), (std::vector{2.0, 2.0, 2.0, 0.5, 0.5, 0.5}));
}

/// The largest difference between the steady flow and the exact one of a sheet at `as_if`, over the nodes
/// that `counts` says count.
template <class Counts>
double largest_error(const LayersStudy& study, double sheet, double as_if, const Counts& counts) {
  const auto velocity = steady_velocities(study, sheet);
  auto exact = exact_layers(study, sheet);
  exact.sheet = as_if;
  double error = 0;
  for (int z = 0; z < study.height; ++z)
    if (counts(z)) error = std::max(error, std::abs(velocity[z] - exact.velocity(z + 0.5)));
  return error;
}

// Sharp viscosities change between two nodes, and the flow is that of a sheet half-way (FluidTwoLayers), with
// the magic parameter 3/16 under a force too. So nothing but the steadiness is left, with which it goes.
TEST(LayersStudy, SharpFlowIsThatOfASheetBetweenTwoCells) {
  const auto all = [](int) { return true; };
  for (const auto flow : {LayersFlow::couette, LayersFlow::channel}) {
    for (const double ratio : {0.01, 0.2, 1.0, 5.0, 100.0}) {
      LayersStudy study{.flow = flow, .viscosity_ratio = ratio, .height = 12};
      EXPECT_LT(largest_error(study, 4.8, 5, all), distance_from_steady(study)) << ratio;
      EXPECT_LT(largest_error(study, 5.3, 5, all), distance_from_steady(study)) << ratio;
      study.steadiness = 1e-4;
      EXPECT_LT(largest_error(study, 5.3, 5, all), distance_from_steady(study)) << ratio;
      EXPECT_GT(largest_error(study, 5.3, 5.3, all), ratio == 1 ? 0 : 1e-4) << ratio;
    }
  }
}

// From a node to the next the velocity goes by half the sum of their 1/mu, so with harmonic shares it has
// gone by the whole of a cell's integral of 1/mu at the end of that cell. Only within the cut cell it is not
// known where: its node has half of it.
TEST(LayersStudy, HarmonicCouetteFlowIsExactOutsideTheCutCell) {
  for (const double sheet : {4.1, 4.4, 4.7}) {
    for (const double ratio : {0.2, 5.0}) {
      LayersStudy study{.form = NodeViscosity::harmonic, .viscosity_ratio = ratio, .height = 12};
      EXPECT_LT(largest_error(study, sheet, sheet, [](int z) { return z != 4; }),
                distance_from_steady(study));
      EXPECT_GT(largest_error(study, sheet, sheet, [](int z) { return z == 4; }), 1e-5);
      study.form = NodeViscosity::arithmetic;
      EXPECT_GT(largest_error(study, sheet, sheet, [](int z) { return z != 4; }), 5e-5);
    }
  }
}

// The magic parameter is what a steady flow depends on.
TEST(LayersStudy, DoesNotDependOnTheRelaxationTime) {
  for (const auto flow : {LayersFlow::couette, LayersFlow::channel}) {
    const LayersStudy study{.flow = flow, .form = NodeViscosity::harmonic, .height = 10};
    auto slower = study;
    slower.relaxation_time = 0.8;
    const auto one = steady_velocities(study, 4.3), other = steady_velocities(slower, 4.3);
    for (std::size_t z = 0; z < one.size(); ++z)
      EXPECT_NEAR(one[z], other[z], 2 * distance_from_steady(study));
  }
}

/// Order of convergence between heights of 16 and 32.
double order(LayersStudy study, double LayersErrors::*error) {
  study.height = 16;
  const double coarse = layers_errors(study).*error;
  study.height = 32;
  return std::log2(coarse / layers_errors(study).*error);
}

// What comes next in an error is 1/H of it, times a number of about one: the order from 16 to 32 is off by up
// to log2((1 + 1/16)/(1 + 1/32)). With arithmetic shares that number is near 2.
const double near = 0.043;

TEST(LayersStudy, SharpErrorsAreOfFirstOrderAndOfSecondInTheMeanOverThePlaces) {
  for (const auto flow : {LayersFlow::couette, LayersFlow::channel}) {
    for (const double ratio : {0.2, 5.0}) {
      const LayersStudy study{.flow = flow, .viscosity_ratio = ratio};
      // The sheet is up to 7/16 off, to either side alike.
      EXPECT_NEAR(order(study, &LayersErrors::nodes_mean), 1, near);
      EXPECT_NEAR(order(study, &LayersErrors::nodes_bias), 2, near);
    }
  }
}

TEST(LayersStudy, HarmonicErrorsInCouetteFlowAreThoseOfOneNode) {
  // Of first order at one node of H: a root mean square of order 3/2.
  const LayersStudy study{.form = NodeViscosity::harmonic};
  EXPECT_NEAR(order(study, &LayersErrors::nodes_mean), 1.5, near);
  EXPECT_NEAR(order(study, &LayersErrors::nodes_bias), 1.5, near);
}

TEST(LayersStudy, ArithmeticErrorsHaveOneSignAndStayOfFirstOrder) {
  const LayersStudy study{.form = NodeViscosity::arithmetic};
  EXPECT_NEAR(order(study, &LayersErrors::nodes_mean), 1, 2 * near);
  EXPECT_NEAR(order(study, &LayersErrors::nodes_bias), 1, 2 * near);
}

// The velocity that sharp viscosities give has its kink between two nodes, of which the kernel makes m tau
// (1/mu_o - 1/mu_i) too much in the mean over the places; m is the sum of |k + 1/2|/2 times the integral of
// phi from k to k + 1, 0.2355 for stockie6. Off by the midpoints of eight places, and by 1/H, for the stress
// tau goes with the place: 2 %. The slope of the interpolated velocity is the mean of those on both sides, at
// places alike above and below, so what the dipole takes off is exact.
TEST(LayersStudy, TheSheetIsOffByItsKinkAndTheDipoleTakesOffMostOfIt) {
  for (const double ratio : {0.2, 5.0}) {
    const LayersStudy study{.viscosity_ratio = ratio, .height = 64};
    const auto exact = exact_layers(study, 24);
    const double outer = exact.viscosity_above, inner = exact.viscosity_below;
    const double rate_above = exact.velocity(64) - exact.velocity(63);
    const double kink = rate_above * (1 - outer / inner) / largest_speed;
    const auto errors = layers_errors(study);
    EXPECT_NEAR(errors.sheet_mean / kink, 0.2355, 0.02 * 0.2355);
    const double length = coupler::dipole_length(coupler::kernel(study.kernel), {outer, inner});
    const double rate = 0.5 * rate_above * (1 + outer / inner) / largest_speed;
    EXPECT_NEAR(errors.dipole_mean - errors.sheet_mean, length * rate, 4 * study.steadiness);
  }
}

TEST(LayersStudy, OneLiquidHasNoErrorInCouetteFlow) {
  for (const auto form : {NodeViscosity::sharp, NodeViscosity::harmonic, NodeViscosity::arithmetic}) {
    const LayersStudy study{.form = form, .viscosity_ratio = 1};
    const auto errors = layers_errors(study);
    for (const double error : {errors.nodes_largest, errors.sheet_largest, errors.dipole_largest})
      EXPECT_LT(error, 2 * study.steadiness);
  }
}

TEST(LayersStudy, IsRefusedWhereAFlowDoesNotBecomeSteady) {
  EXPECT_THROW(steady_velocities({.most_spans = 3}, 12), RunError);
}

TEST(LayersStudy, RefusesWhatIsOutOfRange) {
  for (const LayersStudy& wrong :
       {LayersStudy{.viscosity_ratio = 0}, LayersStudy{.viscosity_ratio = 1e9}, LayersStudy{.height = 0},
        LayersStudy{.height = 4}, LayersStudy{.sheet = 1}, LayersStudy{.sheet = 0.05},
        LayersStudy{.n_places = 0}, LayersStudy{.kernel = "round"}, LayersStudy{.magic_parameter = -1},
        LayersStudy{.relaxation_time = 0.5}, LayersStudy{.steadiness = 1e-13}})
    EXPECT_THROW(layers_errors(wrong), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::driver
