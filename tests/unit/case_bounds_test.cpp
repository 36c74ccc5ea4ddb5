// Every key that is a number refuses what no number of its kind can be, by name and with its whole range.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "driver/case/schema.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

bool is_integral(const Key& key) {
  return key.kind == Kind::integer || key.kind == Kind::integers3 || key.kind == Kind::ranges3;
}

/// The value in the key's form: three times if it holds three numbers.
std::string in_form(const Key& key, const std::string& value) {
  if (key.kind == Kind::integers3 || key.kind == Kind::reals3)
    return "[" + value + ", " + value + ", " + value + "]";
  if (key.kind != Kind::ranges3) return value;
  const auto range = "[" + value + ", " + value + "]";
  return "[" + range + ", " + range + ", " + range + "]";
}

TEST(CaseBounds, IntegersHaveTwoBoundsThatAnIntHolds) {
  for (const auto& key : schema()) {
    if (!is_integral(key)) continue;
    EXPECT_GE(key.range.least, 0) << key.path;
    EXPECT_LE(key.range.greatest, std::numeric_limits<int>::max()) << key.path;
  }
}

TEST(CaseBounds, ABoxOfTheGreatestLengthsIsCountedIn64Bits) {
  EXPECT_LT(std::pow(find_key("flow.box")->range.greatest, 3), 9.2e18);
}

TEST(CaseBounds, WhatIsNoNumberOfTheKindIsRefusedByName) {
  const std::vector<std::string> no_integer = {"1e18", "1.5",        "nan",        "inf",
                                               "-1",   "2147483648", "4294967297", "9223372036854775807"};
  const std::vector<std::string> no_real = {"nan", "inf", "-inf", "true"};
  for (const auto& key : schema()) {
    const bool is_real = key.kind == Kind::real || key.kind == Kind::reals3;
    if (!is_real && !is_integral(key)) continue;
    const auto path = numbered_path(key.path, 0);
    for (const auto& value : is_real ? no_real : no_integer) {
      const auto assignment = path + "=" + in_form(key, value);
      const auto message = refusal(key.path.starts_with("si.") ? si_case : least_case, {assignment});
      EXPECT_THAT(message,
                  AllOf(HasSubstr("--set " + assignment), HasSubstr("must be " + allowed_text(key))));
    }
  }
}

TEST(CaseBounds, TheBoundItselfIsTaken) {
  EXPECT_EQ(
      refusal(least_case,
              {"membrane.viscous={scheme=\"fd\", boussinesq_shear=1, spring_modulus=1, interval=1000000}"}),
      "");
  EXPECT_EQ(refusal(least_case, {"flow.box=[100000, 100000, 100000]", "capsule.0.position=[9, 9, 9]"}), "");
}

}  // namespace
