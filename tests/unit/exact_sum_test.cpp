// A sum of doubles that is the same in every order.
#include "driver/observe/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace {

using tanktread::driver::exact_sum;
using tanktread::driver::ExactSum;

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double infinite = std::numeric_limits<double>::infinity();

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Doubles of all sizes and both signs, each with any bits.
std::vector<double> any_doubles(std::size_t n) {
  std::mt19937_64 random(7);
  std::vector<double> numbers;
  while (numbers.size() < n) {
    const auto number = std::bit_cast<double>(std::uint64_t{random()});
    // So that no sum of them leaves the range of doubles, which would hide what comes after it.
    if (std::isfinite(number) && std::abs(number) < 1e290) numbers.push_back(number);
  }
  return numbers;
}

TEST(ExactSum, OfOneTermIsThatTerm) {
  for (const double term : {0.0, 1.0, -1.0, 0.1, 1e300, -1e-300, largest, -largest, smallest, -smallest,
                            std::numeric_limits<double>::min(), 3 * smallest})
    EXPECT_EQ(sum_of({term}), term);
  for (const double term : any_doubles(2000)) EXPECT_EQ(sum_of({term}), term);
}

TEST(ExactSum, OfTwoTermsIsRoundedAsAdditionIs) {
  const auto numbers = any_doubles(2000);
  for (std::size_t k = 0; k + 1 < numbers.size(); ++k) {
    // Of a like size too, for of two far apart the smaller one is lost.
    int exponent;
    const double mantissa = std::frexp(numbers[k + 1], &exponent);
    const double near = std::ldexp(mantissa, std::ilogb(numbers[k]) - static_cast<int>(k % 60));
    EXPECT_EQ(sum_of({numbers[k], numbers[k + 1]}), numbers[k] + numbers[k + 1]);
    EXPECT_EQ(sum_of({numbers[k], near}), numbers[k] + near) << k;
  }
}

TEST(ExactSum, LosesNothing) {
  EXPECT_EQ(sum_of({1e300, 1, smallest, -1e300, -1}), smallest);
  EXPECT_EQ(sum_of({largest, largest, -largest, -largest, 0.1}), 0.1);
  // 2^53 + 1/2 + 2^-60: just above the middle between two doubles, or just below it, or there: to the even
  // one.
  const double big = std::ldexp(1.0, 53), half_a_step = 1, little = std::ldexp(1.0, -60);
  EXPECT_EQ(sum_of({big, half_a_step}), big);
  EXPECT_EQ(sum_of({big, half_a_step, little}), big + 2);
  EXPECT_EQ(sum_of({big, half_a_step, -little}), big);
  EXPECT_EQ(sum_of({big + 2, half_a_step}), big + 4);
  EXPECT_EQ(sum_of({-big - 2, -half_a_step}), -big - 4);
}

TEST(ExactSum, IsTheSameInEveryOrderAndSharing) {
  auto numbers = any_doubles(3000);
  const double sum = sum_of(numbers);
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    EXPECT_EQ(sum_of(numbers), sum);
    ExactSum of_parts[5];
    for (std::size_t k = 0; k < numbers.size(); ++k) of_parts[random() % 5].add(numbers[k]);
    for (int part = 1; part < 5; ++part) of_parts[0].add(of_parts[part]);
    EXPECT_EQ(of_parts[0].value(), sum);
  }
  for (const int threads : {1, 2, 3, 8}) {
    EXPECT_EQ(exact_sum(3000, threads, [&](std::int64_t k) { return numbers[static_cast<std::size_t>(k)]; })
                  .value(),
              sum);
  }
}

TEST(ExactSum, PassesOnWhatALimbCannotHold) {
  // All bits of the mantissa are set, so that limbs fill up as fast as they can. By sums of sums, for as many
  // terms one by one take years.
  const double term = 2 - std::numeric_limits<double>::epsilon();
  ExactSum sum;
  sum.add(term);
  for (int doubling = 0; doubling < 70; ++doubling) sum.add(ExactSum(sum));
  EXPECT_EQ(sum.value(), std::ldexp(term, 70));
  // 0.1 is 0.1 + 5.6e-18, so that the sum of so many is 1.7e-11 above 3e5, whose neighbour is 5.8e-11 above.
  ExactSum many;
  for (int k = 0; k < 3000000; ++k) many.add(0.1);
  EXPECT_EQ(many.value(), 3e5);
}

TEST(ExactSum, OfWhatIsNotFiniteIsWhatAdditionSays) {
  EXPECT_EQ(sum_of({1, infinite, 2}), infinite);
  EXPECT_EQ(sum_of({1, -infinite}), -infinite);
  EXPECT_TRUE(std::isnan(sum_of({infinite, 1, -infinite})));
  EXPECT_TRUE(std::isnan(sum_of({1, std::numeric_limits<double>::quiet_NaN()})));
  EXPECT_EQ(sum_of({largest, largest}), infinite);
  EXPECT_EQ(sum_of({-largest, -largest}), -infinite);
}

}  // namespace
