// The discrete deltas by themselves: values from the literature and moments (docs/kernels.md).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupler_moments.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

using namespace test;

// Rounding in one kernel value: about ten operations on numbers up to 24 (12 r in peskin4), halved by the
// square root and divided by 8: below 2 eps. (stockie6: numbers up to 33 under the root, divided by 56.) A
// sum over at most 6 points, each with a factor of at most 3: below 36 eps.
constexpr double value_bound = 2 * eps;
constexpr double sum_bound = 36 * eps;

// An extremum between two phases, 2^-10 apart, is missed by up to 2^-11: with a curvature of up to 8 (phi has
// at most 2, and four points) that is 1e-6 off. The moments that are not fractions have seven digits.
constexpr double extremum_bound = 1e-6;

TEST(CouplerKernels, HaveARowEachInTheListOfMoments) {
  std::vector<std::string> names, listed;
  for (const auto& kernel : kernels()) names.push_back(kernel.name);
  for (const auto& row : known_moments()) listed.push_back(row.name);
  EXPECT_EQ(names, listed) << "tests/unit/coupler_moments.hpp";
}

TEST(CouplerKernels, BeginWithTheDefaultOfTheCaseFile) {
  EXPECT_EQ(kernels().front().name, "stockie6");
}

TEST(CouplerKernels, UnknownNameListsTheKnown) {
  std::string known;
  for (const auto& kernel : kernels()) known += (known.empty() ? "" : ", ") + kernel.name;
  try {
    kernel("cosine");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), "unknown kernel 'cosine'; choose from " + known);
  }
}

TEST(CouplerKernels, WeightsAllAtOnceAreThoseOneByOne) {
  int n_kernels = 0;
  for (const auto& kernel : kernels()) {
    if (!kernel.weights) continue;  // called point by point
    ++n_kernels;
    const auto width = static_cast<std::size_t>(std::ceil(2.0 * kernel.half_width));
    std::vector<double> first_distances;
    for (const double s : phases()) first_distances.push_back(1.0 - kernel.half_width - s);
    std::vector<double> weights(width * first_distances.size()), of_one(width);
    kernel.weights(static_cast<int>(first_distances.size()), first_distances.data(), weights.data());
    for (std::size_t k = 0; k < first_distances.size(); ++k) {
      kernel.weights(1, &first_distances[k], of_one.data());
      for (std::size_t point = 0; point < width; ++point) {
        EXPECT_NEAR(weights[width * k + point], kernel.function(first_distances[k] + point), 2 * value_bound);
        EXPECT_EQ(weights[width * k + point], of_one[point]) << "depends on its neighbours";
      }
    }
  }
  EXPECT_GT(n_kernels, 0);
}

class CouplerKernel : public ::testing::TestWithParam<Kernel> {
 protected:
  void SetUp() override { ASSERT_NE(known_, nullptr) << "no row in tests/unit/coupler_moments.hpp"; }

  const Kernel& kernel_ = GetParam();
  const Moments* known_ = known_moments_of(GetParam());
};

TEST_P(CouplerKernel, HasTheValuesByHand) {
  ASSERT_GE(known_->values.size(), 3U);
  for (const auto& [distance, value] : known_->values)
    EXPECT_NEAR(kernel_.function(distance), value, value_bound) << distance;
}

TEST_P(CouplerKernel, IsEvenAndVanishesAtAndBeyondItsHalfWidth) {
  for (double r = 0.0; r < 3.0; r += 1.0 / 128.0) EXPECT_EQ(kernel_.function(-r), kernel_.function(r)) << r;
  for (const double r : {kernel_.half_width, kernel_.half_width + 0.25, 10.0, 1e300})
    EXPECT_EQ(kernel_.function(r), 0.0) << r;
  EXPECT_NE(kernel_.function(kernel_.half_width - 1.0 / 1024.0), 0.0);
}

TEST_P(CouplerKernel, FallsWithDistanceToItsLeastValue) {
  const auto [place, least] = known_->least;
  EXPECT_NEAR(kernel_.function(place), least, extremum_bound);
  for (double r = 0.0; r < kernel_.half_width; r += 1.0 / 128.0) {
    const double here = kernel_.function(r), further = kernel_.function(r + 1.0 / 128.0);
    if (r + 1.0 / 128.0 <= place) {
      EXPECT_GT(here, further) << r;
    } else if (r >= place) {
      EXPECT_LT(here, further) << r;
    }
  }
}

TEST_P(CouplerKernel, PartitionOfUnity) {
  for (const double s : phases())
    EXPECT_NEAR(sum_over_nodes(kernel_, s, [](int) { return 1.0; }), 1.0, sum_bound) << s;
}

TEST_P(CouplerKernel, FirstMomentVanishesJustWhereItIsClaimed) {
  const bool vanishes = known_->first_moment == 0.0;
  EXPECT_EQ(kernel_.first_moment, vanishes);
  EXPECT_NEAR(largest_of_phases(kernel_, first_moment), known_->first_moment,
              vanishes ? sum_bound : extremum_bound);
}

TEST_P(CouplerKernel, EvenOddConditionJustWhereItIsClaimed) {
  const auto even_odd = [](const Kernel& kernel, double s) {
    return sum_over_nodes(kernel, s, [](int j) { return j % 2 ? -1.0 : 1.0; });
  };
  EXPECT_NEAR(largest_of_phases(kernel_, even_odd), known_->even_odd,
              known_->even_odd == 0.0 ? sum_bound : extremum_bound);
}

TEST_P(CouplerKernel, SumOfSquaresIsConstantJustWhereItIsClaimed) {
  double least = 1.0, largest = 0.0;
  for (const double s : phases()) {
    const double sum = sum_over_nodes(kernel_, s, [&](int j) { return kernel_.function(s - j); });
    least = std::min(least, sum);
    largest = std::max(largest, sum);
  }
  const auto [known_least, known_largest] = known_->sum_of_squares;
  const double bound = known_least == known_largest ? sum_bound : extremum_bound;
  EXPECT_NEAR(least, known_least, bound);
  EXPECT_NEAR(largest, known_largest, bound);
}

TEST_P(CouplerKernel, SecondAndFourthMoment) {
  EXPECT_NEAR(mean_square_root_of_phases(kernel_, second_moment), known_->second_moment, 0.5e-4);
  EXPECT_NEAR(mean_square_root_of_phases(kernel_, fourth_moment), known_->fourth_moment, 0.5e-4);
}

INSTANTIATE_TEST_SUITE_P(All, CouplerKernel, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tanktread::coupler
