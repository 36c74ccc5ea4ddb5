// The membrane's parts of the equations of an implicit viscosity: its memory, its relaxation, its state.
// (The equations put together: integration/implicit_step_test.cpp)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>

#include "membrane/implicit_viscosity.hpp"
#include "unit/membrane_strain_rates_support.hpp"

namespace tanktread::membrane::test {
namespace {

using testing::HasSubstr;

ImplicitParameters parameters(RatesAt where, double shear_relaxation = 0,
                              double dilatational_relaxation = 0) {
  return {mu_s, mu_d, shear_relaxation, dilatational_relaxation, where};
}

ImplicitViscosity viscosity(const TriangleMesh& mesh, const ImplicitParameters& of, int threads = 1) {
  ImplicitViscosity result(mesh.triangles, mesh.points.cols(), of, threads);
  result.set_positions(mesh.points);
  return result;
}

/// Whole numbers between -99 and 99 without any order, so that sums and products with powers of two are
/// exact.
Eigen::Matrix3Xd whole_numbers(Eigen::Index n, unsigned seed) {
  return (randomly_moved(Eigen::Matrix3Xd::Zero(3, n), 99, seed).array().round()).matrix();
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(taken)";
}

class ImplicitViscosityAt : public StrainRatesAt {};
INSTANTIATE_TEST_SUITE_P(Both, ImplicitViscosityAt, testing::Values(RatesAt::elements, RatesAt::nodes),
                         name_of);

TEST_P(ImplicitViscosityAt, BeginsWithoutStress) {
  const auto mesh = deformed_sphere(1);
  const auto tested = viscosity(mesh, parameters(GetParam(), 4, 0.5));
  EXPECT_EQ(tested.rates().n_rates(),
            GetParam() == RatesAt::nodes ? mesh.points.cols() : mesh.triangles.cols());
  EXPECT_EQ(tested.stress(), Eigen::Matrix3Xd::Zero(3, tested.rates().n_rates()));
  EXPECT_EQ(tested.guess(), tested.stress());
}

TEST_P(ImplicitViscosityAt, TheGuessGoesOnStraightFromTheLastTwoStresses) {
  auto tested = viscosity(deformed_sphere(1), parameters(GetParam()));
  const auto n = tested.rates().n_rates();
  const Eigen::Matrix3Xd first = whole_numbers(n, 1), second = whole_numbers(n, 2),
                         third = whole_numbers(n, 3);
  tested.accept(first);
  EXPECT_EQ(tested.stress(), first);
  EXPECT_EQ(tested.guess(), 2 * first);  // before it there was none
  tested.accept(second);
  EXPECT_EQ(tested.stress(), second);
  EXPECT_EQ(tested.guess(), 2 * second - first);
  tested.accept(third);
  EXPECT_EQ(tested.guess(), 2 * third - second);
}

TEST_P(ImplicitViscosityAt, MemoryAndDiagonalHaveTheRelaxationOfEachPart) {
  auto tested = viscosity(deformed_sphere(1), parameters(GetParam(), 4, 0.5));
  const auto n = tested.rates().n_rates();
  const Eigen::Matrix3Xd stress = whole_numbers(n, 1), other = whole_numbers(n, 2),
                         before = whole_numbers(n, 3);
  tested.accept(other);
  tested.accept(stress);
  Eigen::Matrix3Xd memory = before, diagonal = before;
  tested.add_memory(memory);
  tested.add_diagonal(other, diagonal);
  const Eigen::DiagonalMatrix<double, 3> theta(4, 4, 0.5), one_more(5, 5, 1.5);
  EXPECT_EQ(memory, before + theta * stress);
  EXPECT_EQ(diagonal, before + one_more * other);
  EXPECT_EQ(tested.stress(), stress) << "neither is a step";
}

TEST_P(ImplicitViscosityAt, WithoutASpringThereIsNoMemory) {
  const auto mesh = deformed_sphere(2);
  auto tested = viscosity(mesh, parameters(GetParam()));
  tested.accept(whole_numbers(tested.rates().n_rates(), 1));
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points),
                         expected = product(tested.rates(), velocity);
  ASSERT_GT(expected.norm(), 1);
  EXPECT_TRUE(same_bits(tested.stress_of(velocity), expected));
}

// s(n) = (B u + theta s(n-1))/(1 + theta) from s(0) = 0 is B u (1 - r^n) with r = theta/(1 + theta). A step
// rounds four times, each at most eps/2 of |B u|, and what it was off before counts r of it: together below
// 2 eps/(1 - r) = 2 eps (1 + theta) of |B u|. pow() and the difference add 2 eps.
TEST_P(ImplicitViscosityAt, AMaxwellElementUnderAConstantRateGoesToTheStressOfTheDashpot) {
  const auto mesh = deformed_sphere(1);
  const double shear = 7.3, dilatational = 0.21;
  auto tested = viscosity(mesh, parameters(GetParam(), shear, dilatational));
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points), dashpot = product(tested.rates(), velocity);
  for (int n = 1; n <= 300; ++n) {
    tested.accept(tested.stress_of(velocity));
    for (int row = 0; row < 3; ++row) {
      const double theta = row == 2 ? dilatational : shear;
      const double part = 1 - std::pow(theta / (1 + theta), n);
      ASSERT_LT((tested.stress().row(row) - part * dashpot.row(row)).cwiseAbs().maxCoeff(),
                2 * epsilon * (2 + theta) * dashpot.row(row).cwiseAbs().maxCoeff())
          << "row " << row << ", step " << n;
    }
  }
  // r^300 is 3e-17: what is left of the beginning is rounding.
  EXPECT_LT((tested.stress() - dashpot).norm(),
            2 * epsilon * (2 + shear) * std::sqrt(dashpot.size()) * dashpot.cwiseAbs().maxCoeff());
}

// The tensors of what is remembered are of some 1 in size; a turn is some ten products of numbers of 1, and a
// mean over six triangles.
constexpr double rounding_of_turn = 200 * epsilon;

TEST_P(ImplicitViscosityAt, AMaxwellElementTurnsWithTheMembrane) {
  const auto mesh = deformed_sphere(1);
  auto tested = viscosity(mesh, parameters(GetParam(), 4, 0.5));
  tested.accept(tested.stress_of(smooth_velocity(mesh.points)));
  const auto before = tested.rates().stress(tested.stress());
  // By far more than a right angle, and moved.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  tested.set_positions((turn * mesh.points).colwise() + Eigen::Vector3d(3, 4, 5));
  const auto after = tested.rates().stress(tested.stress());
  for (Eigen::Index t = 0; t < before.cols(); ++t) {
    const Eigen::Matrix3d from = before.col(t).reshaped<Eigen::RowMajor>(3, 3);
    const Eigen::Matrix3d expected = turn * from * turn.transpose();
    ASSERT_LT((after.col(t).reshaped<Eigen::RowMajor>(3, 3) - expected).norm(),
              rounding_of_turn * before.norm());
  }
}

TEST_P(ImplicitViscosityAt, AMaxwellElementKeepsItsStressWhereTheMembraneGrows) {
  const auto mesh = deformed_sphere(1);
  auto tested = viscosity(mesh, parameters(GetParam(), 4, 0.5));
  tested.accept(tested.stress_of(smooth_velocity(mesh.points)));
  const auto before = tested.rates().stress(tested.stress());
  tested.set_positions(1.5 * mesh.points);
  EXPECT_LT((tested.rates().stress(tested.stress()) - before).norm(), rounding_of_turn * before.norm());
}

// Components along the first edge would turn with that edge, and not with the material: the stress of a
// sheared membrane would hang on which edge comes first.
TEST_P(ImplicitViscosityAt, WhatAMaxwellElementRemembersDoesNotHangOnTheNumbering) {
  const auto mesh = deformed_sphere(1);
  auto other = mesh;
  const auto n = mesh.triangles.cols();
  for (Eigen::Index t = 0; t < n; ++t)
    for (int corner = 0; corner < 3; ++corner)
      other.triangles(corner, t) = mesh.triangles((corner + 1) % 3, n - 1 - t);
  auto one = viscosity(mesh, parameters(GetParam(), 4, 0.5)),
       two = viscosity(other, parameters(GetParam(), 4, 0.5));
  Eigen::Matrix3Xd positions = mesh.points;
  for (int step = 0; step < 20; ++step) {
    const Eigen::Matrix3Xd velocity = 0.05 * smooth_velocity(positions);
    positions += velocity;
    for (auto* tested : {&one, &two}) {
      tested->set_positions(positions);
      tested->accept(tested->stress_of(velocity));
    }
  }
  const auto first = one.rates().stress(one.stress());
  const Eigen::MatrixXd second = two.rates().stress(two.stress()).rowwise().reverse();
  EXPECT_GT(first.norm(), 0.1);
  EXPECT_LT((first - second).norm(), 20 * rounding_of_turn * first.norm());  // of each step
}

TEST_P(ImplicitViscosityAt, AStressOfAVelocityThatIsGivenIsNoStep) {
  const auto mesh = deformed_sphere(1);
  auto tested = viscosity(mesh, parameters(GetParam(), 4, 0.5));
  tested.accept(whole_numbers(tested.rates().n_rates(), 1));
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points), first = tested.stress_of(velocity);
  EXPECT_TRUE(same_bits(tested.stress_of(velocity), first));
}

TEST_P(ImplicitViscosityAt, FollowsThePositions) {
  const auto mesh = deformed_sphere(1);
  auto tested = viscosity(mesh, parameters(GetParam()));
  auto other = mesh;
  other.points = 1.5 * mesh.points;
  tested.set_positions(other.points);
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points);
  EXPECT_TRUE(same_bits(tested.stress_of(velocity), product(at(other, GetParam()), velocity)));
}

TEST_P(ImplicitViscosityAt, GoesOnBitForBitFromItsNumbers) {
  const auto mesh = deformed_sphere(2);
  const auto of = parameters(GetParam(), 7.3, 0.21);
  auto tested = viscosity(mesh, of), other = viscosity(mesh, of);
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points);
  for (const double factor : {1.0, 0.7, -0.3}) tested.accept(tested.stress_of(factor * velocity));
  std::vector<double> values = {17, 19};
  tested.append_to(values);
  ASSERT_EQ(values.size(), 2 + tested.n_values());
  ASSERT_EQ(tested.n_values(), static_cast<std::size_t>(2 * 3 * tested.rates().n_rates()));
  EXPECT_EQ(values[0], 17);
  EXPECT_EQ(values[1], 19);
  EXPECT_EQ(values[2], tested.stress()(0, 0)) << "the stress of now comes first";
  other.restore(std::span(values).subspan(2));
  EXPECT_TRUE(same_bits(other.stress(), tested.stress()));
  EXPECT_TRUE(same_bits(other.guess(), tested.guess()));
  for (auto* viscosity : {&tested, &other}) viscosity->accept(viscosity->stress_of(velocity));
  EXPECT_TRUE(same_bits(other.stress(), tested.stress()));
  EXPECT_TRUE(same_bits(other.guess(), tested.guess()));
}

TEST_P(ImplicitViscosityAt, DoesNotDependOnTheNumberOfThreads) {
  const auto mesh = deformed_sphere(3);
  const Eigen::Matrix3Xd velocity = smooth_velocity(mesh.points);
  const auto one = viscosity(mesh, parameters(GetParam()), 1).stress_of(velocity);
  for (const int threads : {2, 3, 7})
    EXPECT_TRUE(same_bits(viscosity(mesh, parameters(GetParam()), threads).stress_of(velocity), one))
        << threads;
}

TEST_P(ImplicitViscosityAt, RefusesAStateOrAStressOfAnotherSizeAndKeepsItsOwn) {
  auto tested = viscosity(deformed_sphere(1), parameters(GetParam()));
  const auto n = tested.rates().n_rates();
  const Eigen::Matrix3Xd stress = whole_numbers(n, 1);
  tested.accept(stress);
  for (const int more : {-1, 1}) {
    EXPECT_THAT(
        refusal([&] { tested.accept(Eigen::Matrix3Xd::Zero(3, n + more)); }),
        HasSubstr("a stress of " + std::to_string(n + more) + " columns, must have " + std::to_string(n)));
    const std::vector<double> values(static_cast<std::size_t>(6 * n + more));
    EXPECT_THAT(refusal([&] { tested.restore(values); }),
                HasSubstr("a history of " + std::to_string(6 * n + more) + " numbers, " +
                          std::to_string(6 * n) + " are needed"));
  }
  EXPECT_EQ(tested.stress(), stress);
  EXPECT_EQ(tested.guess(), 2 * stress);
}

TEST_P(ImplicitViscosityAt, RefusesParametersOutOfRange) {
  const auto mesh = deformed_sphere(0);
  const double no_number = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {-1e-300, -2.0, no_number, infinite}) {
    EXPECT_THAT(refusal([&] { viscosity(mesh, parameters(GetParam(), bad, 0)); }),
                HasSubstr("shear_relaxation is"));
    EXPECT_THAT(refusal([&] { viscosity(mesh, parameters(GetParam(), 0, bad)); }),
                HasSubstr("dilatational_relaxation is"));
    EXPECT_NE(refusal([&] { viscosity(mesh, {bad, 0, 0, 0, GetParam()}); }), "(taken)");
    EXPECT_NE(refusal([&] { viscosity(mesh, {0, bad, 0, 0, GetParam()}); }), "(taken)");
  }
  EXPECT_EQ(refusal([&] { viscosity(mesh, {0, 0, 0, 0, GetParam()}); }), "(taken)");
}

}  // namespace
}  // namespace tanktread::membrane::test
