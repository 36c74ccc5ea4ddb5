// Whole runs with the fluid in single precision.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "tests/integration/run_fixture.hpp"

namespace {

using namespace tanktread::testing;

const std::vector<std::string> in_single = {"--set", "flow.storage=single"};

/// D in the last row of a table of observables, its third column.
double last_deformation(const std::string& table) {
  const auto begin = table.rfind('\n', table.size() - 2) + 1;
  std::istringstream row(table.substr(begin));
  std::string number;
  for (int column = 0; column < 3; ++column) std::getline(row, number, ',');
  return std::stod(number);
}

TEST_F(Run, InSinglePrecisionGoesOnBitForBit) {
  expect_killed_run_goes_on(in_single);
}

TEST_F(Run, InSinglePrecisionIsNearDoubleAndTheSameForAnyNumberOfThreads) {
  const auto single_on = [&](const std::string& name, const std::string& threads) {
    auto more = in_single;
    more.insert(more.end(), {"--threads", threads});
    return run_program(run_to(name, more)).exit_code;
  };
  ASSERT_EQ(run_program(run_to("double")).exit_code, 0);
  ASSERT_EQ(single_on("one", "1"), 0);
  ASSERT_EQ(single_on("three", "3"), 0);
  const auto table = [&](const char* name) { return read_file(directory_ / name / "observables.csv"); };
  EXPECT_EQ(table("one"), table("three"));
  EXPECT_NE(table("one"), table("double"));
  // A float is right to 6e-8 of itself; 600 steps that all round the same way would make 4e-5 of it.
  const double expected = last_deformation(table("double"));
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(last_deformation(table("one")), expected, 4e-5 * expected);
}

}  // namespace
