// Every energy term of the list on a closed surface: rest, force against energy, objectivity, balance.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "unit/membrane_energy_list.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

/// 80 triangles with edges from 1.09 to 1.24, heights above 0.9.
constexpr double radius = 2, longest_edge = 1.24;

class EnergyForceTest : public testing::TestWithParam<EnergyRow> {
 protected:
  const EnergyRow& row = GetParam();
  const Eigen::Vector3d centre{0.3, -0.2, 0.1};
  TriangleMesh sphere = icosphere(1, radius, centre);
  EnergyTerms terms{sphere, {row.choice}, 1};
  /// Slightly and much deformed, with a node drawn far out, and so flat that its rim folds by more than a
  /// right angle.
  std::vector<Eigen::Matrix3Xd> shapes = {
      randomly_moved(sphere.points, 0.12, 7), randomly_moved(sphere.points, 0.12, 8),
      randomly_moved(sphere.points, 0.3, 9), with_a_spike(randomly_moved(sphere.points, 0.05, 10)),
      Eigen::Vector3d(1, 0.15, 1).asDiagonal() * randomly_moved(sphere.points, 0.1, 11)};

  Eigen::Matrix3Xd with_a_spike(Eigen::Matrix3Xd positions) const {
    positions.col(5) += 2 * (positions.col(5) - centre);
    return positions;
  }

  /// Rounding as if the surface were another one. Coordinates, differences, lengths, normals and angles round
  /// by some 8 epsilon of the farthest coordinate; sums over n triangles by n/2 epsilon, which for an area is
  /// the same as a growth of the surface by n/4 epsilon.
  double position_rounding(const Eigen::Matrix3Xd& positions) const {
    const double n_triangles = static_cast<double>(sphere.triangles.cols());
    return (8 + n_triangles / 4) * epsilon * positions.colwise().norm().maxCoeff();
  }

  /// Such a movement of all nodes against the forces, and the sum of the terms of the energy.
  double energy_rounding(const Eigen::Matrix3Xd& positions) {
    const double n_triangles = static_cast<double>(sphere.triangles.cols());
    return position_rounding(positions) * forces(terms, positions).colwise().norm().sum() +
           n_triangles / 2 * epsilon * terms.energy(positions);
  }

  /// What such a movement makes of a force: by the change of the force under a small random one, 10 for
  /// movements that are worse than that. A node sums up six corners of a size with the largest force.
  double force_rounding(const Eigen::Matrix3Xd& positions) {
    const double small = 1e-6;
    const auto force = forces(terms, positions);
    const double change = (forces(terms, randomly_moved(positions, small, 21)) - force).cwiseAbs().maxCoeff();
    return 10 * position_rounding(positions) * change / small + 60 * epsilon * force.cwiseAbs().maxCoeff();
  }
};

TEST_P(EnergyForceTest, RestsAtTheReferenceOrIsDrawnAlongTheNormals) {
  const auto force = forces(terms, sphere.points);
  if (row.rests) {
    EXPECT_EQ(terms.energy(sphere.points), 0);
    EXPECT_EQ(force.cwiseAbs().maxCoeff(), 0);
    return;
  }
  EXPECT_GT(terms.energy(sphere.points), 0);
  // Each node of this mesh lies on two mirror planes of the icosahedron, so its force is along the normal.
  const double bound = force_rounding(sphere.points);
  EXPECT_GT(force.cwiseAbs().maxCoeff(), 1e6 * bound);
  for (Eigen::Index node = 0; node < force.cols(); ++node) {
    const Eigen::Vector3d f = force.col(node), normal = (sphere.points.col(node) - centre) / radius;
    EXPECT_LT((f - f.dot(normal) * normal).norm(), bound) << node;
  }
}

// Central differences with h = cbrt(eps) times the edge. The truncation is h^2/6 times the third derivative,
// here taken from a third difference of the energy itself at the coarser step H = 1e-3 edges (2: for its own
// error). The rounding: two energies over 2 h.
TEST_P(EnergyForceTest, IsMinusTheDerivativeOfTheEnergy) {
  for (const auto& positions : shapes) {
    const auto force = forces(terms, positions);
    const double largest = force.cwiseAbs().maxCoeff(), rounding = energy_rounding(positions);
    const double h = std::cbrt(epsilon) * longest_edge, coarse = 1e-3 * longest_edge;
    for (Eigen::Index k = 0; k < positions.size(); ++k) {
      const auto energy = [&](double step) {
        Eigen::Matrix3Xd moved = positions;
        moved.data()[k] += step;
        return terms.energy(moved);
      };
      const double third =
          (energy(2 * coarse) - 2 * energy(coarse) + 2 * energy(-coarse) - energy(-2 * coarse)) /
          (2 * std::pow(coarse, 3));
      const double bound = 2 * std::abs(third) * h * h / 6 + rounding / h;
      ASSERT_LT(bound, 1e-5 * largest) << "the bound must be able to see an error";
      EXPECT_NEAR(force.data()[k], -(energy(h) - energy(-h)) / (2 * h), bound) << "coordinate " << k;
    }
  }
}

TEST_P(EnergyForceTest, TurnsAndMovesWithTheSurface) {
  for (const auto& positions : shapes) {
    const auto force = forces(terms, positions);
    for (const double angle : {0.4, 1.2, -2.5}) {
      const Eigen::Matrix3d turn = rotation({std::sin(3 * angle), angle, 0.7}, angle);
      const Eigen::Matrix3Xd moved = (turn * positions).colwise() + Eigen::Vector3d(-7, 12, 5);
      EXPECT_LT((forces(terms, moved) - turn * force).cwiseAbs().maxCoeff(), 2 * force_rounding(moved));
      EXPECT_NEAR(terms.energy(moved), terms.energy(positions), 2 * energy_rounding(moved));
      EXPECT_LT(force_rounding(moved), 1e-8 * force.cwiseAbs().maxCoeff());
    }
  }
}

// The corner forces of a triangle, or of the two at an edge, have neither sum nor moment. Corners carry up to
// ten times the largest force of a node, where those of a nearly flat surface add up to less.
TEST_P(EnergyForceTest, BalancesForceAndTorque) {
  for (const auto& positions : shapes) {
    const auto force = forces(terms, positions);
    const double largest = force.cwiseAbs().maxCoeff();
    const double bound = 3.0 * static_cast<double>(sphere.triangles.cols()) * 8 * epsilon * 10 * largest;
    EXPECT_LT(force.rowwise().sum().norm(), bound);
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    for (Eigen::Index node = 0; node < force.cols(); ++node) {
      const Eigen::Vector3d x = positions.col(node), f = force.col(node);
      torque += x.cross(f);
    }
    EXPECT_LT(torque.norm(), bound * positions.colwise().norm().maxCoeff());
    EXPECT_GT(largest, 1e10 * bound);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTerm, EnergyForceTest, testing::ValuesIn(energy_list()),
                         [](const auto& named) { return named.param.title; });

}  // namespace
}  // namespace tanktread::membrane::test
