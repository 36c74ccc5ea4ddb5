// Nodes that move against a drag: the equations that their velocities solve.
#include "membrane/node_drag.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "membrane/node_areas.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

constexpr double drag = 0.3;
const auto sphere = icosphere(2, 5, {30, 17, 41});

/// Some forces without any symmetry, of the size 1.
Eigen::Matrix3Xd some_forces() {
  return randomly_moved(Eigen::Matrix3Xd::Zero(3, sphere.points.cols()), 1, 3);
}

StrainRates rates_of(double shear, double dilatational, int threads = 1) {
  StrainRates rates(sphere.triangles, sphere.points.cols(), shear, dilatational, RatesAt::elements, threads);
  rates.set_positions(sphere.points);
  return rates;
}

NodeDrag drag_on_sphere() {
  NodeDrag result(sphere.triangles, drag);
  result.set_positions(sphere.points);
  return result;
}

double power(const Eigen::Matrix3Xd& velocity, const Eigen::VectorXd& coefficients) {
  return velocity.colwise().squaredNorm().dot(coefficients);
}

TEST(NodeDrag, TakesUpTheForces) {
  const auto nodes = drag_on_sphere();
  const auto force = some_forces();
  const auto velocity = nodes.velocity(force);
  const auto areas = node_areas(sphere.points, sphere.triangles);
  EXPECT_LT((velocity * areas.asDiagonal() * drag - force).cwiseAbs().maxCoeff(), 10 * epsilon);
}

TEST(NodeDrag, WithViscosityItsEquationsAreSolved) {
  const auto nodes = drag_on_sphere();
  const auto force = some_forces();
  for (const double viscosity : {0.01, 1.0, 1000.0}) {
    const auto rates = rates_of(viscosity, 2 * viscosity);
    Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, force.cols());
    const auto solution = nodes.solve(force, rates, 1e-8, 5000, velocity);
    EXPECT_LE(solution.error, 1e-8);
    Eigen::Matrix3Xd strain(3, rates.n_rates()), viscous(3, force.cols());
    rates.multiply(velocity, strain);
    rates.multiply_transposed(strain, viscous);
    const Eigen::Matrix3Xd missing = force - velocity * nodes.coefficients().asDiagonal() - viscous;
    // The bound on the error is by the residual in the norm of 1/(zeta A); that of the recurrence drifts by
    // rounding, some 1e-16 of the largest entries of the matrix over the smallest.
    EXPECT_LT(std::sqrt(power(nodes.velocity(missing), nodes.coefficients())),
              1.1e-8 * std::sqrt(power(velocity, nodes.coefficients())));
    // What is put in is what is taken up, by the drag and in the membrane.
    EXPECT_NEAR(force.cwiseProduct(velocity).sum(),
                power(velocity, nodes.coefficients()) + strain.squaredNorm(),
                1e-7 * force.cwiseProduct(velocity).sum());
    // From the solution there is nothing to do.
    EXPECT_EQ(nodes.solve(force, rates, 1e-7, 5000, velocity).n_iterations, 0);
  }
}

TEST(NodeDrag, AViscousMembraneMovesAsABodyAllTheSame) {
  const auto nodes = drag_on_sphere();
  const auto rates = rates_of(50, 50);
  Eigen::Matrix3Xd rigid(3, sphere.points.cols());
  for (Eigen::Index node = 0; node < rigid.cols(); ++node) {
    rigid.col(node) =
        Eigen::Vector3d(0.1, 0.2, -0.1) + Eigen::Vector3d(0.02, 0, 0.01).cross(sphere.points.col(node));
  }
  const Eigen::Matrix3Xd force = rigid * nodes.coefficients().asDiagonal();
  Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, force.cols());
  nodes.solve(force, rates, 1e-10, 5000, velocity);
  EXPECT_LT((velocity - rigid).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(NodeDrag, DoesNotDependOnThreads) {
  const auto nodes = drag_on_sphere();
  const auto force = some_forces();
  Eigen::Matrix3Xd one = Eigen::Matrix3Xd::Zero(3, force.cols()), four = one;
  nodes.solve(force, rates_of(5, 3, 1), 1e-8, 5000, one);
  nodes.solve(force, rates_of(5, 3, 4), 1e-8, 5000, four);
  EXPECT_TRUE(same_bits(one, four));
}

TEST(NodeDrag, SaysHowFarItCameAndStandsStillWithoutForces) {
  const auto nodes = drag_on_sphere();
  const auto rates = rates_of(1000, 0);
  Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, sphere.points.cols());
  EXPECT_EQ(nodes.solve(velocity, rates, 1e-8, 100, velocity).error, 0);
  EXPECT_EQ(velocity.norm(), 0);
  const auto solution = nodes.solve(some_forces(), rates, 1e-8, 2, velocity);
  EXPECT_EQ(solution.n_iterations, 2);
  EXPECT_GT(solution.error, 1e-8);
}

TEST(NodeDrag, MustBePositive) {
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(refusal_message([&] { NodeDrag(sphere.triangles, none); }),
              "node drag: the drag must be positive and finite");
}

}  // namespace
}  // namespace tanktread::membrane::test
