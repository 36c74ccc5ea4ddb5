// The tangential correction: its number for each kernel, and what kind of mobility it adds.
#include "coupler/tangential_correction.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/coupler_moments.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::tangential_test {
namespace {

using namespace test;
using Shortfalls = TangentialCorrection::Shortfalls;

const Grid box = {{20, 18, 22}, {true, true, true}};

class TangentialKernels : public ::testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(All, TangentialKernels, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(TangentialKernels, FallShortByTheKnownNumber) {
  const auto* known = known_moments_of(GetParam());
  ASSERT_NE(known, nullptr);
  // The mean over 1024 phases of a function with a second derivative of up to 2: 2/(24 1024^2) = 8e-8; the
  // number of peskin4 has six digits.
  EXPECT_NEAR(tangential_shortfall(GetParam()), known->shortfall, 6e-7);
}

/// A sphere of nodes and what pushes on it, at random.
struct Surface {
  Numbers nodes = sphere(150, 5.0, {9.7, 8.9, 11.3}), normals, force = random_numbers(450, -1, 1, 1);
  Surface() {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double centre[] = {9.7, 8.9, 11.3};
      normals.push_back((nodes[k] - centre[k % 3]) / 5.0);
    }
  }
};

constexpr double already_there = 0.5;  ///< each component of the velocity to which is added

/// The velocity that a correction adds.
Numbers added(const Kernel& kernel, const Surface& surface, const Numbers& force, double viscosity = 0.2) {
  Coupler coupler(box, kernel, 1);
  build(coupler, {surface.nodes});
  Numbers velocity(force.size(), already_there);
  const std::span<const double> normals(surface.normals), forces(force);
  const std::span<double> target(velocity);
  TangentialCorrection(coupler, viscosity).add(coupler, {&normals, 1}, {&forces, 1}, {&target, 1});
  for (double& number : velocity) number -= already_there;
  return velocity;
}

// Rounding: sums of some hundred products below 1, of some thousand grid nodes.
constexpr double rounding = 1e4 * eps;

TEST_P(TangentialKernels, AddASymmetricPositiveMobility) {
  const Surface surface;
  const auto other = random_numbers(450, -1, 1, 2);
  const auto by_force = added(GetParam(), surface, surface.force),
             by_other = added(GetParam(), surface, other);
  EXPECT_NEAR(dot(other, by_force), dot(surface.force, by_other), rounding);
  EXPECT_GT(dot(surface.force, by_force), 0.1);
}

TEST_P(TangentialKernels, LeaveTheNormalVelocityAndNormalForcesAlone) {
  const Surface surface;
  const auto velocity = added(GetParam(), surface, surface.force);
  double largest = 0;
  for (std::size_t k = 0; k < velocity.size(); k += 3) {
    double normal = 0;
    for (int axis = 0; axis < 3; ++axis) {
      normal += velocity[k + axis] * surface.normals[k + axis];
      largest = std::max(largest, std::abs(velocity[k + axis]));
    }
    EXPECT_NEAR(normal, 0, 1e-6) << k;  // normals to 2^-20/5, velocities below 1
  }
  EXPECT_GT(largest, 0.1);
  for (const double number : added(GetParam(), surface, surface.normals)) EXPECT_NEAR(number, 0, 1e-6);
}

TEST(TangentialCorrection, GoesWithTheInverseOfTheViscosity) {
  const Surface surface;
  const auto once = added(kernels().front(), surface, surface.force, 0.2);
  const auto half = added(kernels().front(), surface, surface.force, 0.4);
  for (std::size_t k = 0; k < once.size(); ++k) EXPECT_NEAR(half[k], 0.5 * once[k], 4 * eps);  // sums below 4
}

/// Two spheres whose nodes share grid nodes, and what pushes on each.
struct TwoSurfaces {
  Numbers nodes[2] = {sphere(90, 3.0, {6.2, 8.9, 11.3}), sphere(70, 2.5, {12.4, 8.7, 11.6})};
  Numbers normals[2], force[2] = {random_numbers(270, -1, 1, 3), random_numbers(210, -1, 1, 4)};
  TwoSurfaces() {
    const double centre[2][3] = {{6.2, 8.9, 11.3}, {12.4, 8.7, 11.6}}, radius[2] = {3.0, 2.5};
    for (int which = 0; which < 2; ++which) {
      for (std::size_t k = 0; k < nodes[which].size(); ++k)
        normals[which].push_back((nodes[which][k] - centre[which][k % 3]) / radius[which]);
    }
  }
  /// The velocities that a correction adds, of both surfaces one after the other.
  template <class Missing>
  Numbers added(const Kernel& kernel, const Numbers& first, const Numbers& second,
                const Missing& viscosity_or_shortfalls) const {
    Coupler coupler(box, kernel, 1);
    build(coupler, {nodes[0], nodes[1]});
    Numbers velocity[2] = {Numbers(first.size()), Numbers(second.size())};
    const std::span<const double> n[] = {normals[0], normals[1]}, f[] = {first, second};
    const std::span<double> u[] = {velocity[0], velocity[1]};
    TangentialCorrection(coupler, viscosity_or_shortfalls).add(coupler, n, f, u);
    return joined({velocity[0], velocity[1]});
  }
};

TEST_P(TangentialKernels, AreTheSameByOneViscosityAndByTheShortfallsOfIt) {
  const TwoSurfaces two;
  const auto by_one = two.added(GetParam(), two.force[0], two.force[1], 0.3);
  const double shortfall = tangential_shortfall(GetParam()) / 0.3;
  for (const auto& shortfalls : {Shortfalls{{shortfall, shortfall}}, Shortfalls{{shortfall}}}) {
    const auto by_list = two.added(GetParam(), two.force[0], two.force[1], shortfalls);
    for (std::size_t k = 0; k < by_one.size(); ++k) EXPECT_NEAR(by_list[k], by_one[k], rounding) << k;
  }
}

TEST_P(TangentialKernels, AddASymmetricMobilityBetweenSurfacesOfTwoShortfalls) {
  const TwoSurfaces two;
  const Shortfalls shortfalls = {{2.5, 0.4}};
  const Numbers none[2] = {Numbers(270), Numbers(210)};
  const auto by_first = two.added(GetParam(), two.force[0], none[1], shortfalls);
  const auto by_second = two.added(GetParam(), none[0], two.force[1], shortfalls);
  // What each does to the other, by its own force there.
  const double at_second = dot(two.force[1], Numbers(by_first.begin() + 270, by_first.end())),
               at_first = dot(two.force[0], Numbers(by_second.begin(), by_second.begin() + 270));
  EXPECT_NEAR(at_first, at_second, rounding);
  EXPECT_GT(std::abs(at_first), 1e3 * rounding) << "they are too far apart to see each other";
  // Within a surface it is by its own shortfall; between two by sqrt(K_1 K_2).
  const auto first_by_unit = two.added(GetParam(), two.force[0], none[1], Shortfalls{{1.0}});
  const double mean = std::sqrt(2.5 * 0.4);
  for (std::size_t k = 0; k < by_first.size(); ++k)
    EXPECT_NEAR(by_first[k], first_by_unit[k] * (k < 270 ? 2.5 : mean), 2.5 * rounding) << k;
  // And it takes no energy from the fluid.
  EXPECT_GT(dot(joined({two.force[0], two.force[1]}),
                two.added(GetParam(), two.force[0], two.force[1], shortfalls)),
            0);
}

TEST(TangentialCorrection, LeavesASurfaceThatDoesNotFallShortAlone) {
  const TwoSurfaces two;
  const auto velocity = two.added(kernels().front(), two.force[0], two.force[1], Shortfalls{{0.0, 1.0}});
  EXPECT_EQ(Numbers(velocity.begin(), velocity.begin() + 270), Numbers(270));
  EXPECT_NE(Numbers(velocity.begin() + 270, velocity.end()), Numbers(210));
}

TEST(TangentialCorrection, RefusesShortfallsThatAreNotOneASurface) {
  const Coupler coupler(box, kernels().front(), 1);
  EXPECT_THROW(TangentialCorrection(coupler, Shortfalls{}), std::invalid_argument);
  for (const double shortfall : {-1e-3, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const Shortfalls list = {{0.2, shortfall}};
    EXPECT_THROW(TangentialCorrection(coupler, list), std::invalid_argument) << shortfall;
  }
  const TwoSurfaces two;
  for (const double third : {0.2, 0.3}) {
    const Shortfalls list = {{0.2, 0.2, third}};
    EXPECT_THROW(two.added(kernels().front(), two.force[0], two.force[1], list), std::invalid_argument);
  }
}

TEST(TangentialCorrection, RefusesAViscosityThatIsNotPositive) {
  const Coupler coupler(box, kernels().front(), 1);
  for (const double viscosity : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(TangentialCorrection(coupler, viscosity), std::invalid_argument) << viscosity;
  }
}

TEST(TangentialCorrection, RefusesArraysThatDoNotFit) {
  const Surface surface;
  Coupler coupler(box, kernels().front(), 1);
  build(coupler, {surface.nodes});
  const TangentialCorrection correction(coupler, 0.2);
  Numbers velocity(450);
  const std::span<const double> normals(surface.normals), force(surface.force);
  const std::span<double> target(velocity), short_target = target.first(447);
  EXPECT_THROW(correction.add(coupler, {&normals, 1}, {&force, 1}, {&short_target, 1}),
               std::invalid_argument);
  EXPECT_THROW(correction.add(coupler, {}, {&force, 1}, {&target, 1}), std::invalid_argument);
  Coupler other(box, kernels().back(), 1);
  build(other, {surface.nodes});
  EXPECT_THROW(correction.add(other, {&normals, 1}, {&force, 1}, {&target, 1}), std::invalid_argument);
  Kernel same_name = kernels().back();  // a kernel is its function, not its name
  same_name.name = kernels().front().name;
  Coupler disguised(box, same_name, 1);
  build(disguised, {surface.nodes});
  EXPECT_THROW(correction.add(disguised, {&normals, 1}, {&force, 1}, {&target, 1}), std::invalid_argument);
}

TEST(TangentialCorrection, NamesTheNodeWithoutANormalOrAForceAndAddsNothing) {
  Surface surface;
  Coupler coupler(box, kernels().front(), 1);
  build(coupler, {surface.nodes});
  Numbers velocity(450, already_there);
  const auto message = [&]() -> std::string {
    const std::span<const double> normals(surface.normals), force(surface.force);
    const std::span<double> target(velocity);
    try {
      TangentialCorrection(coupler, 0.2).add(coupler, {&normals, 1}, {&force, 1}, {&target, 1});
    } catch (const CorrectionError& error) {
      return error.what();
    }
    return "none";
  };
  surface.force[3 * 17 + 1] = std::nan("");
  EXPECT_EQ(message(), "the force of node 17 of surface 0 is not finite");
  surface.normals[3 * 9] = std::nan("");
  EXPECT_EQ(message(), "the normal of node 9 of surface 0 is not finite");
  EXPECT_EQ(velocity, Numbers(450, already_there));
}

}  // namespace
}  // namespace tanktread::coupler::tangential_test
