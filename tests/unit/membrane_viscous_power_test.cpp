// What becomes of the power that goes into the viscous stress of a membrane: dashpots and springs.
#include <gtest/gtest.h>

#include <cmath>

#include "membrane/implicit_viscosity.hpp"
#include "unit/membrane_strain_rates_support.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane::test::viscous_power_test {
namespace {

double sum(const ViscousPower& power) {
  return power.shear + power.dilatational + power.spring;
}

double power_of(const Eigen::Matrix3Xd& force, const Eigen::Matrix3Xd& velocity) {
  return force.cwiseProduct(velocity).sum();
}

/// Some thousand terms of either sign.
constexpr double rounding = 1000 * epsilon;

TEST(ViscousPower, IsWhatTheViscousForcesTakeFromAnyVelocities) {
  const auto mesh = icosphere(2, 1);
  for (const auto& form : viscous_forms()) {
    auto parameters = soft();
    parameters.scheme = form.scheme;
    parameters.measure = form.measure;
    auto membrane = viscous_membrane(mesh, parameters);
    Eigen::Matrix3Xd force;
    for (int step = 1; step <= 5; ++step) force = viscous_forces(membrane, moved(mesh, step));
    const auto velocity = smooth_velocity(mesh.points);
    const auto power = membrane.viscous_power(velocity);
    const double scale = force.cwiseAbs().cwiseProduct(velocity.cwiseAbs()).sum();
    EXPECT_NEAR(sum(power), -power_of(force, velocity), rounding * scale) << form;
    EXPECT_GT(power.shear, 1e-4 * scale);
    EXPECT_GT(power.dilatational, 1e-4 * scale);
  }
}

TEST(ViscousPower, OfAMembraneWithoutViscosityOrAtRestIsZero) {
  const auto mesh = deformed_sphere(1);
  const Membrane elastic(mesh, skalak(), 1);
  const auto resting = viscous_membrane(mesh, soft());
  const auto velocity = smooth_velocity(mesh.points);
  for (const auto* membrane : {&elastic, &resting}) {
    const auto power = membrane->viscous_power(velocity);
    EXPECT_EQ(power.shear, 0);
    EXPECT_EQ(power.dilatational, 0);
    EXPECT_EQ(power.spring, 0);
  }
  EXPECT_THROW(elastic.viscous_power(Eigen::Matrix3Xd::Zero(3, 5)), std::invalid_argument);
}

// With tau = dt/2 central differences give the stress 2 mu times the rate of the step that was done, without
// a memory: that of the implicit viscosity of elements, but for the move itself, of first order in it.
TEST(ViscousPower, OfDashpotsIsThatOfTheImplicitViscosity) {
  const auto mesh = icosphere(2, 1);
  const auto relative_difference = [&](double time) {
    ViscousParameters parameters;
    parameters.scheme = "fd";
    parameters.shear_viscosity = mu_s;
    parameters.dilatational_viscosity = mu_d;
    parameters.shear_spring = 2 * 2 * mu_s;
    parameters.dilatational_spring = 2 * 2 * mu_d;
    auto membrane = viscous_membrane(mesh, parameters);
    const Eigen::Matrix3Xd velocity = time * smooth_velocity(mesh.points);
    const Eigen::Matrix3Xd positions = mesh.points + velocity;
    viscous_forces(membrane, positions);
    const auto found = membrane.viscous_power(velocity);
    ImplicitViscosity implicit(mesh.triangles, mesh.points.cols(), {mu_s, mu_d, 0, 0, RatesAt::elements}, 1);
    implicit.set_positions(positions);
    implicit.accept(implicit.stress_of(velocity));
    const auto expected = implicit.power(velocity);
    return Eigen::Array3d(found.shear / expected.shear - 1, found.dilatational / expected.dilatational - 1,
                          found.spring / sum(expected));
  };
  const Eigen::Array3d coarse = relative_difference(2e-4), fine = relative_difference(1e-4);
  EXPECT_LT(fine.abs().maxCoeff(), 2e-3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(coarse[k] / fine[k], 2, 0.02) << k;
}

class ViscousPowerAt : public StrainRatesAt {};
INSTANTIATE_TEST_SUITE_P(Both, ViscousPowerAt, testing::Values(RatesAt::elements, RatesAt::nodes), name_of);

// |B u|^2 without a spring; with one the stress takes s.(B u), of which the dashpots dissipate |s|^2.
TEST_P(ViscousPowerAt, OfAnImplicitViscosityIsThatOfItsStress) {
  const auto mesh = deformed_sphere(2);
  const auto velocity = smooth_velocity(mesh.points);
  for (const auto& [shear, dilatational] : {std::pair{0.0, 0.0}, {4.0, 0.0}, {0.0, 0.5}, {4.0, 0.5}}) {
    ImplicitViscosity tested(mesh.triangles, mesh.points.cols(),
                             {mu_s, mu_d, shear, dilatational, GetParam()}, 1);
    tested.set_positions(mesh.points);
    tested.accept(tested.stress_of(velocity));
    const auto power = tested.power(velocity);
    const Eigen::Matrix3Xd rates = product(tested.rates(), velocity);
    EXPECT_NEAR(sum(power), power_of(transposed_product(tested.rates(), tested.stress()), velocity),
                rounding * rates.squaredNorm());
    // s = B u/(1 + theta) from rest.
    EXPECT_NEAR(power.shear, rates.topRows<2>().squaredNorm() / std::pow(1 + shear, 2),
                rounding * rates.squaredNorm());
    EXPECT_NEAR(power.dilatational, rates.row(2).squaredNorm() / std::pow(1 + dilatational, 2),
                rounding * rates.squaredNorm());
    if (shear == 0 && dilatational == 0) {
      EXPECT_EQ(power.spring, 0);
    } else {
      EXPECT_GT(power.spring, 1e-3 * rates.squaredNorm());
    }
  }
}

// Without a spring what is missing from B u is no power of a spring.
TEST_P(ViscousPowerAt, OfAStressThatIsOffItsRatesStaysOutOfTheSprings) {
  const auto mesh = deformed_sphere(1);
  const auto velocity = smooth_velocity(mesh.points);
  ImplicitViscosity tested(mesh.triangles, mesh.points.cols(), {mu_s, mu_d, 0, 0, GetParam()}, 1);
  tested.set_positions(mesh.points);
  tested.accept(0.9 * tested.stress_of(velocity));
  EXPECT_EQ(tested.power(velocity).spring, 0);
  EXPECT_NEAR(sum(tested.power(velocity)), 0.81 * product(tested.rates(), velocity).squaredNorm(),
              rounding * sum(tested.power(velocity)));
}

}  // namespace
}  // namespace tanktread::membrane::test::viscous_power_test
