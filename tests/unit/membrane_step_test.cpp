// The time step of several membranes together: it is that of each by itself.
#include "membrane/membrane_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane {
namespace {

using namespace test;

/// Different sizes: part of a block of elements, and many. One of them has most elements.
const std::vector<int> different_levels = {1, 2, 0, 3};
/// So many membranes that each thread takes whole ones.
const std::vector<int> many_levels(40, 1);

/// Elastic and viscous membranes by turns.
struct Membranes {
  explicit Membranes(int threads, const std::vector<int>& levels = different_levels) {
    for (const int level : levels) meshes.push_back(icosphere(level, 5));
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      if (k % 2 == 0) {
        all.emplace_back(meshes[k], skalak(), threads);
      } else {
        all.push_back(viscous_membrane(meshes[k], soft(), threads));
      }
    }
    forces.resize(all.size());
    for (const auto& mesh : meshes) positions.push_back(mesh.points);
    for (std::size_t k = 0; k < all.size(); ++k) forces[k].setConstant(3, all[k].n_nodes(), 7.0);
  }

  /// @param without_force one that is only checked; -1: none
  void advance_to(int step, int without_force = -1) {
    std::vector<MembraneStep> steps;
    for (std::size_t k = 0; k < all.size(); ++k) {
      positions[k] = moved(meshes[k], step);
      if (k == inverted_membrane) positions[k] = meshes[k].points.rowwise().reverse();
      steps.push_back({&all[k], &positions[k], static_cast<int>(k) == without_force ? nullptr : &forces[k]});
    }
    advance(steps);
  }

  std::vector<std::vector<double>> histories() const {
    std::vector<std::vector<double>> all_histories;
    for (const auto& membrane : all) all_histories.push_back(membrane.history());
    return all_histories;
  }

  std::vector<TriangleMesh> meshes;
  std::vector<Membrane> all;
  std::vector<Eigen::Matrix3Xd> positions, forces;
  std::size_t inverted_membrane = 99;
};

TEST(MembraneStep, OfManyIsThatOfEachToTheLastBit) {
  for (const auto& levels : {different_levels, many_levels}) {
    for (const int threads : {1, 2, 3, 16}) {
      Membranes together(threads, levels), alone(1, levels);
      for (int step = 1; step <= 3; ++step) {
        together.advance_to(step);
        for (std::size_t k = 0; k < alone.all.size(); ++k) {
          Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, alone.all[k].n_nodes());
          alone.all[k].set_positions(moved(alone.meshes[k], step));
          alone.all[k].add_forces(force);
          EXPECT_TRUE(same_bits(together.forces[k], force))
              << "membrane " << k << ", " << threads << " threads";
          EXPECT_TRUE(same_bits(together.all[k].positions(), alone.all[k].positions())) << k;
        }
        EXPECT_EQ(together.histories(), alone.histories());
      }
    }
  }
}

TEST(MembraneStep, WithoutAForceIsTheCheckOfTheElements) {
  Membranes membranes(2), other(2);
  const auto before = membranes.all[3].history();
  membranes.advance_to(1, 3);
  EXPECT_TRUE((membranes.forces[3].array() == 7.0).all());
  other.all[3].set_positions(moved(other.meshes[3], 1));
  other.all[3].check_elements();
  EXPECT_EQ(membranes.all[3].history(), other.all[3].history());
  EXPECT_NE(membranes.all[3].history(), before);
}

TEST(MembraneStep, WithABadElementLeavesAllHistoriesAndNamesTheFirst) {
  for (const auto& levels : {different_levels, many_levels}) {
    for (const std::size_t inverted : {1, 3}) {
      Membranes membranes(3, levels), alone(1, levels);
      membranes.advance_to(1);
      const auto histories = membranes.histories();
      membranes.inverted_membrane = inverted;
      std::string message, expected;
      try {
        membranes.advance_to(2);
      } catch (const InvertedElement& error) {
        message = error.what();
      }
      alone.advance_to(1);
      alone.all[inverted].set_positions(membranes.positions[inverted]);
      try {
        alone.all[inverted].check_elements();
      } catch (const InvertedElement& error) {
        expected = error.what();
      }
      EXPECT_THAT(message, testing::HasSubstr("membrane element "));
      EXPECT_EQ(message, expected);
      EXPECT_EQ(membranes.histories(), histories);
    }
  }
}

TEST(MembraneStep, RefusesArraysOfAnotherNumberOfNodes) {
  Membranes membranes(1);
  Eigen::Matrix3Xd wrong = Eigen::Matrix3Xd::Zero(3, 5);
  const MembraneStep positions{&membranes.all[0], &wrong, &membranes.forces[0]};
  EXPECT_THROW(advance({&positions, 1}), std::invalid_argument);
  const MembraneStep force{&membranes.all[0], nullptr, &wrong};
  EXPECT_THROW(advance({&force, 1}), std::invalid_argument);
  EXPECT_NO_THROW(advance({}));
}

}  // namespace
}  // namespace tanktread::membrane
