// Every elastic law of the list that has a force on a closed surface: rest, force against energy,
// objectivity.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "membrane/shape.hpp"
#include "unit/membrane_law_list.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// 80 triangles of area below `largest_area` with edges from 1.09 to 1.24.
constexpr double radius = 2, largest_area = 0.67, longest_edge = 1.24;
constexpr int corners_in_a_node = 6;

class LawForceTest : public testing::TestWithParam<LawRow> {
 protected:
  const LawRow& row = GetParam();
  TriangleMesh sphere = icosphere(1, radius, {0.3, -0.2, 0.1});
  Membrane membrane{sphere, make_elastic_law(row.name, row.parameters), 1};
  /// Bounds dS/dE and S at the strains of these tests (stretches within 0.7 .. 1.4).
  double stiffness = 10 * (row.shear_modulus + row.area_modulus + row.tension_at_rest);

  /// A corner force is area times stress times shape gradient, at most stress times half an edge; a rounding
  /// of F enters the stress twice (Cg = F^T F) and the force once more.
  double force_rounding(const Eigen::Matrix3Xd& positions) const {
    return corners_in_a_node * 3 * stiffness * gradient_rounding(sphere, positions) * longest_edge / 2;
  }
};

TEST_P(LawForceTest, RestsWithoutForceOrWithAnEvenTension) {
  const auto force = forces(membrane, sphere.points);
  const double bound = force_rounding(sphere.points);
  const double area = surface_area(sphere.points, sphere.triangles);
  EXPECT_NEAR(membrane.elastic_energy(), row.tension_at_rest * area,
              stiffness * gradient_rounding(sphere, sphere.points) * area);
  if (row.tension_at_rest == 0) {
    EXPECT_LT(force.cwiseAbs().maxCoeff(), bound);
    return;
  }
  // Each node of this mesh lies on two mirror planes of the icosahedron, so its force is along the normal.
  const Eigen::Matrix3Xd normals = (sphere.points.colwise() - Eigen::Vector3d(0.3, -0.2, 0.1)) / radius;
  for (Eigen::Index node = 0; node < force.cols(); ++node) {
    const Eigen::Vector3d f = force.col(node), normal = normals.col(node);
    EXPECT_LT(f.dot(normal), -0.1 * row.tension_at_rest) << node;
    EXPECT_LT((f - f.dot(normal) * normal).norm(), bound) << node;
  }
  EXPECT_LT(force.rowwise().sum().norm(), bound * std::sqrt(force.cols()));
  // Virtual work of a growing radius: gamma dA = 2 gamma A dR/R.
  EXPECT_NEAR(force.cwiseProduct(normals * radius).sum(), -2 * row.tension_at_rest * area,
              bound * radius * static_cast<double>(force.cols()));
}

// Central differences with h = cbrt(eps) times the edge. The truncation is h^2/6 times the third derivative,
// here taken from a third difference of the energy itself at the coarser step H = 1e-3 edges (2: for its own
// error). The rounding: adding n elements rounds the energy n/2 eps; the elements of the node round by their
// stress times the rounding of F; two energies over 2 h.
TEST_P(LawForceTest, IsMinusTheDerivativeOfTheEnergy) {
  const Eigen::Matrix3Xd positions = randomly_moved(sphere.points, 0.12, 7);
  const auto force = forces(membrane, positions);
  const double largest = force.cwiseAbs().maxCoeff();
  ASSERT_GT(largest, 0.05 * stiffness / 10);
  const double energy_rounding =
      membrane.n_triangles() / 2.0 * epsilon * membrane.elastic_energy() +
      corners_in_a_node * largest_area * stiffness * gradient_rounding(sphere, positions);
  const double h = std::cbrt(epsilon) * longest_edge, coarse = 1e-3 * longest_edge;
  for (Eigen::Index k = 0; k < positions.size(); ++k) {
    const auto energy = [&](double step) {
      Eigen::Matrix3Xd moved = positions;
      moved.data()[k] += step;
      membrane.set_positions(moved);
      return membrane.elastic_energy();
    };
    const double third =
        (energy(2 * coarse) - 2 * energy(coarse) + 2 * energy(-coarse) - energy(-2 * coarse)) /
        (2 * std::pow(coarse, 3));
    const double bound = 2 * std::abs(third) * h * h / 6 + energy_rounding / h;
    ASSERT_LT(bound, 1e-5 * largest) << "the bound must be able to see an error";
    EXPECT_NEAR(force.data()[k], -(energy(h) - energy(-h)) / (2 * h), bound) << "coordinate " << k;
  }
}

TEST_P(LawForceTest, IsObjective) {
  const Eigen::Matrix3Xd positions = randomly_moved(sphere.points, 0.12, 11);
  const auto force = forces(membrane, positions);
  const double energy = membrane.elastic_energy();
  const double area = surface_area(sphere.points, sphere.triangles);
  for (const double angle : {0.4, 1.2, -1.5}) {
    const Eigen::Matrix3d turn = rotation({std::sin(3 * angle), angle, 0.7}, angle);
    const Eigen::Matrix3Xd moved = (turn * positions).colwise() + Eigen::Vector3d(-1, 2, 0.5);
    Membrane other(sphere, make_elastic_law(row.name, row.parameters), 1);
    // A turn of more than a right angle in one step would be taken for an inversion: two half turns.
    forces(other, rotation({std::sin(3 * angle), angle, 0.7}, angle / 2) * positions);
    EXPECT_LT((forces(other, moved) - turn * force).cwiseAbs().maxCoeff(), 2 * force_rounding(moved));
    EXPECT_NEAR(other.elastic_energy(), energy, stiffness * 2 * gradient_rounding(sphere, moved) * area);
  }
}

// Total force and torque vanish to rounding, for the corner forces of an element sum to zero and their
// moments too.
TEST_P(LawForceTest, BalancesForceAndTorque) {
  const Eigen::Matrix3Xd positions = randomly_moved(sphere.points, 0.12, 3);
  const auto force = forces(membrane, positions);
  const double per_corner = 8 * epsilon * stiffness * longest_edge / 2;
  const double n_corners = 3.0 * membrane.n_triangles();
  EXPECT_LT(force.rowwise().sum().norm(), n_corners * per_corner);
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (Eigen::Index node = 0; node < force.cols(); ++node) {
    const Eigen::Vector3d x = positions.col(node), f = force.col(node);
    torque += x.cross(f);
  }
  EXPECT_LT(torque.norm(), n_corners * per_corner * 1.5 * radius);
  EXPECT_GT(force.cwiseAbs().maxCoeff(), 1e10 * n_corners * per_corner);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, LawForceTest, testing::ValuesIn(laws_with_a_force()),
                         [](const auto& named) { return test_name(named.param); });

TEST(NoLaw, HasNeitherForceNorEnergyInAnyShape) {
  const auto sphere = icosphere(1, radius);
  Membrane membrane(sphere, make_elastic_law("none", {}), 1);
  EXPECT_EQ(forces(membrane, randomly_moved(sphere.points, 0.12, 5)).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(membrane.elastic_energy(), 0);
}

}  // namespace
}  // namespace tanktread::membrane::test
