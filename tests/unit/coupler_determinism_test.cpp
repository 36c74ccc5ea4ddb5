// What must be equal to the last bit: any number of threads, and surfaces together or as one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler::determinism_test {
namespace {

using namespace test;

const Grid box = {{24, 20, 23}, {true, true, true}};

/// Two surfaces that overlap, so that their forces add up on shared grid nodes, and one across three faces.
const std::vector<Numbers> surfaces = {sphere(400, 6.0, {11.0, 9.0, 12.0}),
                                       sphere(301, 5.5, {12.0, 9.0, 11.0}),
                                       sphere(200, 4.5, {23.5, 0.3, 22.0})};
const std::vector<std::size_t> sizes = {400, 301, 200};

bool same_bits(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class CouplerDeterminism : public ::testing::TestWithParam<Kernel> {
 protected:
  void SetUp() override { build(one_thread_, surfaces); }

  Coupler one_thread_{box, GetParam(), 1};
  // Forces of very different sizes: another order of addition shows in the last bits.
  const std::vector<Numbers> force_ = {random_numbers(1200, -1, 1, 1), random_numbers(903, -1e3, 1e3, 2),
                                       random_numbers(600, -1e-3, 1e-3, 3)};
};

TEST_P(CouplerDeterminism, AnyNumberOfThreadsGivesTheSameBits) {
  const Numbers field = random_numbers(3 * one_thread_.grid_nodes().size(), -1, 1, 4);
  const Numbers velocity = interpolate(one_thread_, field, sizes), grid_force = spread(one_thread_, force_);
  for (const int threads : {2, 3, 4, 7, 64, 0}) {  // 64: more than there are planes
    Coupler coupler(box, GetParam(), threads);
    build(coupler, surfaces);
    ASSERT_TRUE(std::ranges::equal(coupler.grid_nodes(), one_thread_.grid_nodes())) << threads;
    EXPECT_TRUE(same_bits(interpolate(coupler, field, sizes), velocity)) << threads;
    EXPECT_TRUE(same_bits(spread(coupler, force_), grid_force)) << threads;
  }
}

// The correction of the velocities, all in one array.
Numbers corrected(const Coupler& coupler, const std::vector<Numbers>& normals,
                  const std::vector<Numbers>& force) {
  const std::vector<std::span<const double>> normal_spans(normals.begin(), normals.end()),
      force_spans(force.begin(), force.end());
  std::vector<Numbers> velocity;
  for (const auto& numbers : force) velocity.emplace_back(numbers.size(), 0.1);
  const std::vector<std::span<double>> targets(velocity.begin(), velocity.end());
  TangentialCorrection(coupler, 0.2).add(coupler, normal_spans, force_spans, targets);
  return joined(velocity);
}

TEST_P(CouplerDeterminism, ACorrectionHasTheSameBitsForAnyNumberOfThreadsAndSurfaces) {
  std::vector<Numbers> normals;
  for (const auto& force : force_) normals.push_back(random_numbers(force.size(), -1, 1, 6));
  const Numbers expected = corrected(one_thread_, normals, force_);
  for (const int threads : {2, 7, 0}) {
    Coupler coupler(box, GetParam(), threads), together(box, GetParam(), threads);
    build(coupler, surfaces);
    build(together, {joined(surfaces)});
    EXPECT_TRUE(same_bits(corrected(coupler, normals, force_), expected)) << threads;
    EXPECT_TRUE(same_bits(corrected(together, {joined(normals)}, {joined(force_)}), expected)) << threads;
  }
}

TEST_P(CouplerDeterminism, AnotherOrderOfMembraneNodesWouldShow) {
  // The test above can fail: the same forces in reversed order change bits, and nothing but rounding.
  const auto reversed = [](const Numbers& numbers) {
    Numbers result;
    for (std::size_t k = numbers.size(); k >= 3; k -= 3)
      result.insert(result.end(), &numbers[k - 3], &numbers[k - 3] + 3);
    return result;
  };
  build(one_thread_, {surfaces[0]});
  const Numbers forwards = spread(one_thread_, {force_[0]});
  build(one_thread_, {reversed(surfaces[0])});
  const Numbers backwards = spread(one_thread_, {reversed(force_[0])});
  EXPECT_FALSE(same_bits(backwards, forwards));
  for (std::size_t k = 0; k < forwards.size(); ++k) ASSERT_NEAR(backwards[k], forwards[k], 400 * eps);
}

TEST_P(CouplerDeterminism, SeveralSurfacesAreOneOfAllTheirNodes) {
  Coupler together(box, GetParam(), 2);
  build(together, {joined(surfaces)});
  ASSERT_TRUE(std::ranges::equal(together.grid_nodes(), one_thread_.grid_nodes()));
  const Numbers field = random_numbers(3 * together.grid_nodes().size(), -1, 1, 5);
  EXPECT_TRUE(same_bits(interpolate(together, field, {901}), interpolate(one_thread_, field, sizes)));
  EXPECT_TRUE(same_bits(spread(together, {joined(force_)}), spread(one_thread_, force_)));
}

TEST_P(CouplerDeterminism, AStencilMayReachThePlanesOfAThreadFromBothSides) {
  // As wide as the grid: behind the periodic face come planes that its first thread has as well.
  const Grid small = {{6, 7, 6}, {true, true, true}};
  const Numbers nodes = sphere(60, 2.0, {3.0, 3.0, 3.0}), force = random_numbers(180, -1, 1, 7);
  Coupler one_thread(small, GetParam(), 1);
  build(one_thread, {nodes});
  const Numbers grid_force = spread(one_thread, {force});
  for (const int threads : {2, 3, 4, 7}) {
    Coupler coupler(small, GetParam(), threads);
    build(coupler, {nodes});
    EXPECT_TRUE(same_bits(spread(coupler, {force}), grid_force)) << threads;
  }
}

TEST_P(CouplerDeterminism, StencilsDoNotDependOnWhatWasBuiltBefore) {
  Coupler used(box, GetParam(), 2);
  for (const double x : {3.0, 20.0, 11.0}) build(used, {sphere(500, 4.0, {x, 9.0, 12.0}), surfaces[2]});
  build(used, surfaces);
  ASSERT_TRUE(std::ranges::equal(used.grid_nodes(), one_thread_.grid_nodes()));
  EXPECT_TRUE(same_bits(spread(used, force_), spread(one_thread_, force_)));
}

INSTANTIATE_TEST_SUITE_P(All, CouplerDeterminism, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tanktread::coupler::determinism_test
