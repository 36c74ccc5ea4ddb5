// What a run says at its end of its time and of what bounds it.
#include "driver/run/closing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "driver/run/memory_speed.hpp"

namespace {

using namespace tanktread::driver;
using ::testing::HasSubstr;

TEST(Closing, EachAccountHasItsRowAndTheRestToo) {
  StepSeconds seconds;
  seconds.fluid = 50;
  seconds.forced_nodes = 10;
  seconds.stencils = 8;
  seconds.interpolation = 6;
  seconds.spreading = 4;
  seconds.correction = 2;
  seconds.membranes = 12.3456;
  EXPECT_EQ(time_table(seconds, 5, 100),
            "time of              seconds        %\n"
            "  fluid               50.000     50.0\n"
            "  forced nodes        10.000     10.0\n"
            "  stencils             8.000      8.0\n"
            "  interpolation        6.000      6.0\n"
            "  spreading            4.000      4.0\n"
            "  correction           2.000      2.0\n"
            "  membranes           12.346     12.3\n"
            "  files                5.000      5.0\n"
            "  else                 2.654      2.7\n");
  seconds.implicit = 2;  // of the runs that have such forces
  EXPECT_THAT(time_table(seconds, 5, 100), HasSubstr("  membranes           12.346     12.3\n"
                                                     "  implicit forces      2.000      2.0\n"
                                                     "  files                5.000      5.0\n"
                                                     "  else                 0.654      0.7\n"));
}

TEST(Closing, TheFluidIsHeldAgainstMemory) {
  EXPECT_THAT(bound_line(30e9, 40e9), HasSubstr("30.0 GB/s at the least, 75 % of the 40.0 GB/s"));
  EXPECT_EQ(bound_line(30e9, 0), "");  // memory could not be measured
}

TEST(Closing, TheSpeedOfMemoryIsThatOfAPlainLoop) {
  constexpr int n_passes = 12, n = 1 << 24;  // beyond most caches, where memory is the bound of both loops
  std::vector<double> numbers(n, 1.0);
  volatile double one = 1.0;
  double shortest = 1e300;
  for (int pass = 0; pass < n_passes; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    const double factor = one;
    for (double& number : numbers) number *= factor;
    shortest =
        std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_EQ(numbers.back(), 1.0);
  const double plain = 16.0 * static_cast<double>(numbers.size()) / shortest;
  // Test code is optimised by half, and the machine may be busy. Numbers taken for bytes are a factor of 8,
  // all passes taken for one 12.
  const double speed = update_in_place_speed(n, n_passes, 10, 1);
  EXPECT_GT(speed, plain / 5);
  EXPECT_LT(speed, 6 * plain);
}

TEST(Closing, NoMemoryIsNoSpeed) {
  EXPECT_EQ(update_in_place_speed(std::numeric_limits<std::int64_t>::max() / 16, 1, 1), 0);
}

}  // namespace
