// The table of a kernel: the numbers of the library, at the distances said.
#include <gtest/gtest.h>

#include <sstream>

#include "coupler/coupler.hpp"
#include "driver/study/study_kernel.hpp"

namespace tanktread::driver {
namespace {

TEST(KernelStudy, HoldsEveryKernelToItsHalfWidthToTheLastBit) {
  for (const auto& kernel : coupler::kernels()) {
    std::istringstream table(kernel_table({kernel.name, 8}));
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line, "kernel,distance,phi");
    int row = 0;
    for (; std::getline(table, line); ++row) {
      const auto first = line.find(','), second = line.rfind(',');
      EXPECT_EQ(line.substr(0, first), kernel.name);
      EXPECT_EQ(std::stod(line.substr(first + 1)), row / 8.0);
      EXPECT_EQ(std::stod(line.substr(second + 1)), kernel.function(row / 8.0)) << kernel.name << row;
    }
    EXPECT_EQ(row, 8 * kernel.half_width + 1) << kernel.name;
  }
}

TEST(KernelStudy, RefusesWhatItCannotTabulate) {
  for (const int points : {-2, 0, 1, 7, 65538})
    EXPECT_THROW(kernel_table({"roma3", points}), std::invalid_argument) << points;
  EXPECT_THROW(kernel_table({"gaussian", 8}), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::driver
