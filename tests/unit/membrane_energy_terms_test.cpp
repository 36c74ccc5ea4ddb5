// Energy terms together: their sum, threads, the table, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "unit/membrane_energy_list.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(EnergyTerms, TellTheTermsApart) {
  const auto sphere = icosphere(2, 2);
  const auto positions = randomly_moved(sphere.points, 0.1, 3);
  EnergyTerms all(sphere, one_of_each(), 1);
  const auto energies = all.energies(positions);
  ASSERT_EQ(energies.size(), all.size());
  EXPECT_EQ(all.energy(positions), std::accumulate(energies.begin(), energies.end(), 0.0));

  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, positions.cols());
  double largest = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EnergyTerms alone(sphere, {one_of_each()[k]}, 1);
    EXPECT_EQ(all.name(k), one_of_each()[k].name);
    EXPECT_EQ(energies[k], alone.energy(positions));
    EXPECT_GT(energies[k], 0);
    Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, positions.cols());
    all.add_forces_of(k, positions, force);
    EXPECT_TRUE(same_bits(force, forces(alone, positions))) << all.name(k);
    largest = std::max(largest, force.cwiseAbs().maxCoeff());
    sum += force;
  }
  // The derivatives of all terms are added up before they become forces: some 20 roundings at six corners,
  // which carry up to ten times the force of a node.
  EXPECT_LT((forces(all, positions) - sum).cwiseAbs().maxCoeff(), 6 * 20 * 10 * epsilon * largest);
}

TEST(EnergyTerms, AddIntoTheForceTheyAreGiven) {
  const auto sphere = icosphere(1, 2);
  const auto positions = randomly_moved(sphere.points, 0.1, 4);
  EnergyTerms terms(sphere, one_of_each(), 1);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Constant(3, positions.cols(), 1.5);
  const Eigen::Matrix3Xd expected = force + forces(terms, positions);
  terms.add_forces(positions, force);
  EXPECT_TRUE(same_bits(force, expected));
}

TEST(EnergyTerms, NoResultDependsOnTheNumberOfThreads) {
  const auto sphere = icosphere(2, 2, {30, 30, 30});  // 20 blocks of triangles, 30 of edges, 162 nodes
  const auto positions = randomly_moved(sphere.points, 0.1, 5);
  EnergyTerms one(sphere, one_of_each(), 1);
  const auto energies = one.energies(positions);
  const auto force = forces(one, positions);
  for (const int threads : {2, 3, 7}) {
    EnergyTerms several(sphere, one_of_each(), threads);
    EXPECT_TRUE(same_bits(several.energies(positions), energies)) << threads;
    EXPECT_TRUE(same_bits(forces(several, positions), force)) << threads;
  }
}

// What was measured before must not stay: with and without curvature, there and back.
TEST(EnergyTerms, KeepNothingBetweenCalls) {
  const auto sphere = icosphere(1, 2);
  const auto positions = randomly_moved(sphere.points, 0.1, 6);
  EnergyTerms used(sphere, one_of_each(), 1), fresh(sphere, one_of_each(), 1);
  Eigen::Matrix3Xd other = Eigen::Matrix3Xd::Zero(3, positions.cols());
  for (std::size_t k = 0; k < used.size(); ++k) used.add_forces_of(k, 1.1 * sphere.points, other);
  EXPECT_TRUE(same_bits(forces(used, positions), forces(fresh, positions)));
}

TEST(EnergyTerms, WithoutATermThereIsNoForce) {
  const auto sphere = icosphere(1, 2);
  EnergyTerms none(sphere, {}, 1);
  EXPECT_EQ(none.energy(sphere.points), 0);
  EXPECT_EQ(forces(none, sphere.points).cwiseAbs().maxCoeff(), 0);
}

TEST(EnergyTerms, RefuseSurfacesThatAreNotClosed) {
  auto open = icosphere(1, 2);
  open.triangles.conservativeResize(3, 79);
  EXPECT_THAT(refusal_message([&] { EnergyTerms(open, one_of_each()); }),
              AllOf(HasSubstr("energy terms: the surface is open"), HasSubstr("close it")));
  EXPECT_THAT(refusal_message([] { EnergyTerms(turned_inside_out(icosphere(1, 2)), {}); }),
              HasSubstr("energy terms: the surface is inside out"));
}

TEST(EnergyTerms, RefuseNegativeThreadsATermTwiceAndArraysOfAnotherSize) {
  const auto sphere = icosphere(0, 1);
  EXPECT_THAT(refusal_message([&] { EnergyTerms(sphere, {}, -1); }),
              HasSubstr("threads = -1; 0 (all) or more is needed"));
  const EnergyChoice choice = {"volume", {{"volume_modulus", 1}}};
  EXPECT_THAT(refusal_message([&] {
                EnergyTerms(sphere, {choice, choice});
              }),
              HasSubstr("energy terms: volume is named twice; add up its moduli"));
  EnergyTerms terms(sphere, {choice}, 1);
  Eigen::Matrix3Xd few = Eigen::Matrix3Xd::Zero(3, 11), right = sphere.points;
  EXPECT_THAT(refusal_message([&] { terms.energy(few); }),
              AllOf(HasSubstr("position array has 11 columns"), HasSubstr("12 nodes")));
  EXPECT_THAT(refusal_message([&] { terms.add_forces(sphere.points, few); }),
              AllOf(HasSubstr("force array has 11 columns"), HasSubstr("12 nodes")));
  EXPECT_THROW(terms.add_forces_of(1, sphere.points, right), std::out_of_range);
}

TEST(EnergyTermTable, HasATestRowForEveryTerm) {
  std::set<std::string> tested, known;
  for (const auto& row : energy_list()) tested.insert(row.choice.name);
  for (const auto& entry : energy_term_table()) known.insert(entry.name);
  EXPECT_EQ(tested, known);
}

TEST(EnergyTermTable, ListsTheKnownNamesWhenOneIsUnknown) {
  const auto message = refusal_message([] { EnergyTerms(icosphere(0, 1), {{"bendin", {}}}); });
  EXPECT_THAT(message, HasSubstr("unknown energy term 'bendin'"));
  for (const auto& entry : energy_term_table()) EXPECT_THAT(message, HasSubstr(entry.name));
}

TEST(EnergyTermTable, RefusesParametersWithTermNameValueAndRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<EnergyChoice, std::string>> list = {
      {{"bending", {}},
       "bending: bending_modulus is missing (kappa_b, force times length), must be 0 or positive"},
      {{"bending", {{"bending_modulus", -1e-9}}},
       "bending: bending_modulus is -1e-09, must be 0 or positive"},
      {{"bending", {{"bending_modulus", 1}, {"spontaneous_curvature", nan}}},
       "bending: spontaneous_curvature is nan, must be finite"},
      {{"bending", {{"bending_modulus", 1}, {"area_modulus", 1}}},
       "bending: it has no parameter 'area_modulus'; it has bending_modulus, spontaneous_curvature"},
      {{"global-area", {{"area_modulus", -1}}}, "global-area: area_modulus is -1, must be 0 or positive"},
      {{"global-area", {{"area_modulus", 1}, {"reference_area", 0}}},
       "global-area: reference_area is 0, must be positive"},
      {{"local-area", {{"local_area_modulus", nan}}},
       "local-area: local_area_modulus is nan, must be 0 or positive"},
      {{"local-area", {{"local_area_modulus", 1}, {"reference_area", -4}}},
       "local-area: reference_area is -4, must be positive"},
      {{"volume", {{"volume_modulus", -2}}}, "volume: volume_modulus is -2, must be 0 or positive"},
      {{"volume", {{"volume_modulus", 1}, {"reference_volume", -0.5}}},
       "volume: reference_volume is -0.5, must be positive"},
  };
  for (const auto& [choice, message] : list) {
    EXPECT_EQ(refusal_message([&] { EnergyTerms(icosphere(0, 1), {choice}); }), "energy term " + message);
  }
}

}  // namespace
}  // namespace tanktread::membrane::test
