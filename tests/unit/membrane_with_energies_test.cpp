// A membrane with energy terms beside its law: its forces, and the step of several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "membrane/membrane_step.hpp"
#include "unit/membrane_energy_list.hpp"
#include "unit/membrane_viscous_support.hpp"

namespace tanktread::membrane {
namespace {

using namespace test;

Eigen::Matrix3Xd step_forces(Membrane& membrane, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, membrane.n_nodes());
  membrane.set_positions(positions);
  membrane.add_forces(force);
  return force;
}

std::unique_ptr<EnergyTerms> terms_of(const TriangleMesh& mesh, int threads = 1) {
  return std::make_unique<EnergyTerms>(mesh, one_of_each(), threads);
}

// Both are sums over the corners of a node: some 20 roundings at six corners, which carry up to ten times the
// force of a node.
TEST(MembraneWithEnergies, AddsTheForcesOfTheTermsToThoseOfTheLaws) {
  const auto sphere = icosphere(2, 2);
  const auto positions = randomly_moved(sphere.points, 0.05, 3);
  for (const bool viscous : {false, true}) {
    const auto make = [&] {
      return viscous ? viscous_membrane(sphere, soft(), 1) : Membrane(sphere, skalak(), 1);
    };
    auto with = make(), without = make();
    with.set_energy_terms(terms_of(sphere));
    const auto total = step_forces(with, positions), laws = step_forces(without, positions);
    Eigen::Matrix3Xd sum = laws;
    for (std::size_t k = 0; k < with.energy_terms()->size(); ++k) with.add_term_forces(k, sum);
    const double largest = total.cwiseAbs().maxCoeff();
    EXPECT_GT((total - laws).cwiseAbs().maxCoeff(), 0.1 * largest);
    EXPECT_LT((total - sum).cwiseAbs().maxCoeff(), 6 * 20 * 10 * epsilon * largest);
    EXPECT_EQ(with.history(), without.history());
    EXPECT_EQ(with.elastic_energy(), without.elastic_energy());

    Eigen::Matrix3Xd elastic = Eigen::Matrix3Xd::Zero(3, with.n_nodes()), of_law = elastic;
    with.add_elastic_forces(elastic);
    without.add_elastic_forces(of_law);
    EXPECT_TRUE(same_bits(elastic, of_law));
  }
}

TEST(MembraneWithEnergies, TellsTheEnergyOfEachTerm) {
  const auto sphere = icosphere(2, 2);
  const auto positions = randomly_moved(sphere.points, 0.05, 4);
  Membrane membrane(sphere, skalak(), 1);
  EXPECT_EQ(membrane.energy_terms(), nullptr);
  EXPECT_TRUE(membrane.term_energies().empty());
  membrane.set_energy_terms(terms_of(sphere));
  membrane.set_positions(positions);
  EXPECT_EQ(membrane.term_energies(), terms_of(sphere)->energies(positions));
}

// A cell may start as another shape than that without stress: its areas and its volume are those of the
// start.
TEST(MembraneWithEnergies, RestsWhereItsTermsDoNotWhereItsLawDoes) {
  const auto sphere = icosphere(2, 2), larger = icosphere(2, 3);
  Membrane membrane(sphere, make_elastic_law("none", {}), 1);
  membrane.set_energy_terms(std::make_unique<EnergyTerms>(
      larger, std::vector<EnergyChoice>{{"local-area", {{"local_area_modulus", 2}}},
                                        {"volume", {{"volume_modulus", 2}}}}));
  EXPECT_EQ(step_forces(membrane, larger.points).cwiseAbs().maxCoeff(), 0);
  EXPECT_GT(step_forces(membrane, sphere.points).cwiseAbs().maxCoeff(), 0.1);
}

TEST(MembraneWithEnergies, RefusesTermsOfOtherTriangles) {
  Membrane membrane(icosphere(1, 2), skalak(), 1);
  EXPECT_THAT(refusal_message([&] { membrane.set_energy_terms(terms_of(icosphere(2, 2))); }),
              testing::HasSubstr("energy terms of other triangles"));
  auto turned = icosphere(1, 2);
  turned.triangles.col(0) = icosphere(1, 2).triangles(Eigen::Vector3i(1, 2, 0), 0);
  EXPECT_THAT(refusal_message([&] { membrane.set_energy_terms(terms_of(turned)); }),
              testing::HasSubstr("energy terms of other triangles"));
  Eigen::Matrix3Xd force = membrane.positions();
  EXPECT_THROW(membrane.add_term_forces(0, force), std::out_of_range);
}

/// Elastic, viscous, with terms and without by turns.
struct Membranes {
  explicit Membranes(int threads, const std::vector<int>& levels) {
    for (std::size_t k = 0; k < levels.size(); ++k) {
      meshes.push_back(icosphere(levels[k], 5));
      if (k % 2 == 0) {
        all.emplace_back(meshes[k], skalak(), threads);
      } else {
        all.push_back(viscous_membrane(meshes[k], soft(), threads));
      }
      // Bending alone needs the curvature, and a list without it none.
      auto choices = one_of_each();
      if (k % 5 == 4) choices.erase(choices.begin());
      if (k % 3 != 0) all[k].set_energy_terms(std::make_unique<EnergyTerms>(meshes[k], choices, threads));
    }
    forces.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) forces[k].setConstant(3, all[k].n_nodes(), 7.0);
  }

  std::vector<TriangleMesh> meshes;
  std::vector<Membrane> all;
  std::vector<Eigen::Matrix3Xd> forces;
};

TEST(MembraneWithEnergies, TheStepOfManyIsThatOfEachToTheLastBit) {
  const std::vector<std::vector<int>> all_levels = {{1, 2, 0, 3, 2, 1}, {3}, std::vector<int>(40, 1)};
  for (const auto& levels : all_levels) {
    for (const int threads : {1, 2, 3, 16}) {
      Membranes together(threads, levels), alone(1, levels);
      if (levels.size() == 1) {
        together.all[0].set_energy_terms(terms_of(together.meshes[0], threads));
        alone.all[0].set_energy_terms(terms_of(alone.meshes[0]));
      }
      for (int step = 1; step <= 2; ++step) {
        std::vector<Eigen::Matrix3Xd> positions;
        for (const auto& mesh : together.meshes) positions.push_back(moved(mesh, step));
        std::vector<MembraneStep> steps;
        for (std::size_t k = 0; k < positions.size(); ++k)
          steps.push_back({&together.all[k], &positions[k], &together.forces[k]});
        advance(steps);
        for (std::size_t k = 0; k < positions.size(); ++k) {
          EXPECT_TRUE(same_bits(together.forces[k], step_forces(alone.all[k], positions[k])))
              << "membrane " << k << " of " << levels.size() << ", " << threads << " threads";
          EXPECT_TRUE(same_bits(together.all[k].term_energies(), alone.all[k].term_energies()));
        }
      }
    }
  }
}

TEST(MembraneWithEnergies, ACheckAloneLeavesTheForce) {
  const auto sphere = icosphere(1, 2);
  Membrane membrane(sphere, skalak(), 1);
  membrane.set_energy_terms(terms_of(sphere));
  EXPECT_NO_THROW(membrane.check_elements());
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Constant(3, membrane.n_nodes(), 7.0);
  const Eigen::Matrix3Xd inverted = sphere.points.rowwise().reverse();
  const MembraneStep step{&membrane, &inverted, &force};
  EXPECT_THROW(advance({&step, 1}), InvertedElement);
}

}  // namespace
}  // namespace tanktread::membrane
