// Kinematics of one triangle, and the force of a stress in it, against maps whose answer is known.
#include "membrane/element.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test::element_test {
namespace {

/// A triangle of edges 1.5 to 2.5 somewhere in space. Entries of F below carry 12 eps |x|/height = 50
/// epsilon.
const Eigen::Matrix3d triangle =
    (Eigen::Matrix3d() << 0.2, 1.9, 0.6, -0.4, 0.3, 1.7, 1.0, 0.1, 1.3).finished();
constexpr double rounding = 50 * epsilon;

/// The axes that the element's reference plane has in space.
SurfaceGradient reference_axes() {
  SurfaceGradient axes;
  axes.col(0) = (triangle.col(1) - triangle.col(0)).normalized();
  axes.col(1) = area_normal(triangle).normalized().cross(axes.col(0));
  return axes;
}

/// A linear map of all of space, neither symmetric nor a rotation.
const Eigen::Matrix3d map =
    (Eigen::Matrix3d() << 1.2, 0.3, -0.1, -0.2, 0.9, 0.25, 0.15, 0.05, 1.1).finished();

SurfaceGradient gradient_of_map() {
  return deformation_gradient(map * triangle, reference_element(triangle));
}

TEST(ReferenceElement, HasTheAreaAndShapeFunctionsOfATriangleByHand) {
  // Right angle at corner 0, legs 2 and 3.
  const Eigen::Matrix3d corners = (Eigen::Matrix3d() << 1, 3, 1, 1, 1, 4, 5, 5, 5).finished();
  const auto element = reference_element(corners);
  EXPECT_DOUBLE_EQ(element.area, 3);
  const Eigen::Matrix<double, 3, 2> expected =
      (Eigen::Matrix<double, 3, 2>() << -0.5, -1.0 / 3, 0.5, 0, 0, 1.0 / 3).finished();
  EXPECT_LT((element.shape_gradient - expected).cwiseAbs().maxCoeff(), 4 * epsilon);
}

TEST(DeformationGradient, IsTheMapOnTheAxesOfTheReferencePlane) {
  EXPECT_LT((gradient_of_map() - map * reference_axes()).cwiseAbs().maxCoeff(), rounding);
}

TEST(DeformationGradient, IsTheReferenceFrameAtRestWhereverTheElementIs) {
  const Eigen::Matrix3d moved = triangle.colwise() + Eigen::Vector3d(3, -1, 2);
  const auto gradient = deformation_gradient(moved, reference_element(triangle));
  EXPECT_LT((gradient - reference_axes()).cwiseAbs().maxCoeff(), 3 * rounding);
  EXPECT_LT((cauchy_green(gradient).matrix() - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(),
            6 * rounding);
}

TEST(SymmetricTensor, IsTheMatrixOfItsComponents) {
  const Eigen::Matrix2d a = (Eigen::Matrix2d() << 1.5, 0.3, 0.3, 0.8).finished();
  const Eigen::Matrix2d b = (Eigen::Matrix2d() << 2.0, -0.7, -0.7, 0.5).finished();
  const auto as = SymmetricTensor::of(a), bs = SymmetricTensor::of(b);
  EXPECT_EQ(as.matrix(), a);
  EXPECT_EQ((as + bs).matrix(), a + b);
  EXPECT_EQ((as - bs).matrix(), a - b);
  EXPECT_EQ((2.5 * as).matrix(), 2.5 * a);
  EXPECT_EQ(unit_tensor.matrix(), Eigen::Matrix2d::Identity());
  EXPECT_EQ(as.trace(), a.trace());
  EXPECT_NEAR(as.determinant(), a.determinant(), 2 * epsilon);
  // Entries below 5 from a dozen roundings.
  EXPECT_LT((on_both_sides(as, bs).matrix() - a * b * a).cwiseAbs().maxCoeff(), 12 * 5 * epsilon);
}

TEST(PolarDecomposition, GivesAPositiveStretchAndTwoOrthonormalAxes) {
  const auto gradient = gradient_of_map();
  const Eigen::Matrix2d c = cauchy_green(gradient).matrix();
  const auto found = right_stretch(cauchy_green(gradient));
  const Eigen::Matrix2d stretch = found.inverse.matrix().inverse();
  const auto turn = polar_rotation(gradient, found);
  EXPECT_NEAR(found.area_ratio, stretch.determinant(), 20 * epsilon);
  EXPECT_LT((stretch * stretch - c).cwiseAbs().maxCoeff(), 20 * epsilon);
  EXPECT_GT(stretch.trace(), 0);
  EXPECT_GT(stretch.determinant(), 0);
  EXPECT_LT((turn * stretch - gradient).cwiseAbs().maxCoeff(), 20 * epsilon);
  EXPECT_LT((turn.transpose() * turn - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 40 * epsilon);
}

TEST(PolarDecomposition, FindsAStretchAndARotationThatWerePutIn) {
  const Eigen::Matrix2d stretch = (Eigen::Matrix2d() << 1.5, 0.3, 0.3, 0.8).finished();
  const SurfaceGradient axes = rotation({1, 2, -1}, 2.0).leftCols<2>();
  const SurfaceGradient gradient = axes * stretch;
  const auto found = right_stretch(cauchy_green(gradient));
  EXPECT_LT((found.inverse.matrix().inverse() - stretch).cwiseAbs().maxCoeff(), 20 * epsilon);
  EXPECT_LT((polar_rotation(gradient, found) - axes).cwiseAbs().maxCoeff(), 60 * epsilon);
}

TEST(PrincipalStretches, KeepTheirDigitsWhenOneIsTiny) {
  const Eigen::Matrix2d axes = rotation({0, 0, 1}, 0.6).topLeftCorner<2, 2>();
  const Eigen::Matrix2d stretch = axes * Eigen::Vector2d(3.0, 1e-3).asDiagonal() * axes.transpose();
  const auto stretches = principal_stretches(SymmetricTensor::of(stretch * stretch));
  EXPECT_NEAR(stretches[0], 3.0, 20 * epsilon);
  // The determinant of Cg, 9e-6, is a difference of numbers below 20: 20 eps/9 is the error of lambda2
  // squared.
  EXPECT_NEAR(stretches[1], 1e-3, 5 * epsilon / 1e-3);
}

// A Cauchy stress s in the frame of the rotation is sigma = R s R^T in space; pulling it back to S and
// pushing S forward must give it again.
TEST(PulledBack, IsTheSecondPiolaKirchhoffStressOfACauchyStress) {
  const auto gradient = gradient_of_map();
  const auto stretch = right_stretch(cauchy_green(gradient));
  const auto turn = polar_rotation(gradient, stretch);
  const Eigen::Matrix2d stress = (Eigen::Matrix2d() << 2.0, -0.7, -0.7, 0.5).finished();
  const Eigen::Matrix3d in_space = turn * stress * turn.transpose();
  EXPECT_LT((cauchy_stress(gradient, pulled_back(SymmetricTensor::of(stress), stretch)) - in_space)
                .cwiseAbs()
                .maxCoeff(),
            200 * epsilon);
}

// An even tension pulls each edge by half its length times the tension, in the plane and across the edge, so
// a corner gets half the tension times (normal x opposite edge): the derivative of the area by that corner.
TEST(CornerForces, OfAnEvenTensionAreMinusTheDerivativeOfTheArea) {
  const Eigen::Matrix3d corners = map * triangle;
  const auto gradient = gradient_of_map();
  const double tension = 1.7;
  const auto stress = pulled_back(tension * unit_tensor, right_stretch(cauchy_green(gradient)));
  const auto force = corner_forces(gradient, stress, reference_element(triangle));
  const Eigen::Vector3d normal = area_normal(corners).normalized();
  for (int corner = 0; corner < 3; ++corner) {
    const Eigen::Vector3d opposite = corners.col((corner + 2) % 3) - corners.col((corner + 1) % 3);
    const Eigen::Vector3d expected = -0.5 * tension * normal.cross(opposite);
    EXPECT_LT((force.col(corner) - expected).norm(), 10 * rounding) << corner;
  }
  EXPECT_LT(force.rowwise().sum().norm(), rounding);
}

}  // namespace
}  // namespace tanktread::membrane::test::element_test
