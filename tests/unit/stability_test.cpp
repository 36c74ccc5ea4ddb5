// How stiff an artificial spring may be, by kernel.
#include <gtest/gtest.h>

#include "coupler/coupler.hpp"
#include "driver/units/stability.hpp"

namespace tanktread::driver {
namespace {

TEST(Stability, EveryKernelHasARowOfItsOwn) {
  // A kernel without a row gets the least of all, which are those of linear2.
  for (const bool corrected : {false, true}) {
    const double least = stable_interval_times_spring("no kernel", corrected);
    EXPECT_GT(least, 0);
    for (const auto& kernel : coupler::kernels()) {
      if (kernel.name == "linear2") {
        EXPECT_EQ(stable_interval_times_spring(kernel.name, corrected), least);
      } else {
        EXPECT_GT(stable_interval_times_spring(kernel.name, corrected), least) << kernel.name;
      }
    }
  }
}

TEST(Stability, ANodeThatMovesFurtherStandsLess) {
  for (const auto& kernel : coupler::kernels())
    EXPECT_LT(stable_interval_times_spring(kernel.name, true),
              stable_interval_times_spring(kernel.name, false))
        << kernel.name;
}

}  // namespace
}  // namespace tanktread::driver
