// Which kernel a case has, and whether it has the tangential correction, where it does not say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupler/coupler.hpp"
#include "driver/case/names.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread;
using namespace tanktread::testing;
using ::testing::HasSubstr;

std::string written(bool value) {
  return value ? "true" : "false";
}

TEST(CaseCoupler, TheDefaultKernelIsTheFirstOfTheTable) {
  const auto& first = coupler::kernels().front();
  EXPECT_EQ(driver::Case().coupler.kernel, first.name);
  EXPECT_EQ(driver::Case().coupler.tangential_correction, first.gains_by_correction);
  EXPECT_EQ(parse(least_case).coupler, driver::CouplerCase());
}

TEST(CaseCoupler, TheCorrectionFollowsTheKernelUnlessTheCaseSaysIt) {
  for (const auto& kernel : coupler::kernels()) {
    const auto named = "coupler.kernel=" + kernel.name;
    EXPECT_EQ(parse(least_case, {named}).coupler.tangential_correction, kernel.gains_by_correction)
        << kernel.name;
    const auto in_file = least_case + "[coupler]\nkernel = \"" + kernel.name + "\"\n";
    EXPECT_EQ(parse(in_file).coupler.tangential_correction, kernel.gains_by_correction) << kernel.name;
    for (const bool said : {false, true}) {
      const auto set = "coupler.tangential_correction=" + written(said);
      EXPECT_EQ(parse(least_case, {named, set}).coupler.tangential_correction, said) << kernel.name;
      const auto both = in_file + "tangential_correction = " + written(said) + "\n";
      EXPECT_EQ(parse(both).coupler.tangential_correction, said) << kernel.name;
    }
  }
}

TEST(CaseCoupler, TheShearDipoleFollowsTheCorrectionUnlessTheCaseSaysIt) {
  for (const bool corrected : {false, true}) {
    const auto correction = "coupler.tangential_correction=" + written(corrected);
    EXPECT_EQ(parse(least_case, {correction}).coupler.shear_dipole, corrected);
    for (const bool said : {false, true}) {
      const auto set = "coupler.shear_dipole=" + written(said);
      EXPECT_EQ(parse(least_case, {correction, set}).coupler.shear_dipole, said);
      EXPECT_EQ(parse(least_case, {correction, set}).coupler.tangential_correction, corrected);
    }
  }
}

TEST(CaseCoupler, AnEchoWritesTheCorrectionAndKeepsItWithAnotherKernel) {
  for (const auto& kernel : coupler::kernels()) {
    const auto echo = to_toml(parse(least_case, {"coupler.kernel=" + kernel.name}));
    EXPECT_THAT(echo, HasSubstr("tangential_correction = " + written(kernel.gains_by_correction)));
    for (const auto& other : coupler::kernels()) {
      const auto again = parse(echo, {"coupler.kernel=" + other.name});
      EXPECT_EQ(again.coupler.kernel, other.name);
      EXPECT_EQ(again.coupler.tangential_correction, kernel.gains_by_correction) << other.name;
      // With the table in its place nothing is written: the correction is the other kernel's.
      const auto table = parse(echo, {"coupler={kernel = \"" + other.name + "\"}"});
      EXPECT_EQ(table.coupler.tangential_correction, other.gains_by_correction) << other.name;
    }
  }
}

TEST(CaseCoupler, AnEchoOfAnEarlierDefaultIsTheCaseThatItWas) {
  // As it was written when the default was cosine4 without the correction, with its [coupler].
  const auto echo = least_case + "[coupler]\nkernel = \"cosine4\"\ntangential_correction = false\n";
  EXPECT_EQ(parse(echo).coupler, (driver::CouplerCase{"cosine4", false, false}));
  EXPECT_TRUE(parse(echo) == parse(least_case, {"coupler.kernel=cosine4"}));
}

}  // namespace
