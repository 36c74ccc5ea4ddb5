// Keys of very many parts are refused before toml++ reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/case/key_depth.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;

/// "a.a.a ..." of so many parts.
std::string parts(int n, const std::string& part = "a", const std::string& dot = ".") {
  std::string key = part;
  for (int k = 1; k < n; ++k) key += dot + part;
  return key;
}

TEST(KeyDepth, IsCountedInEveryFormOfAKey) {
  EXPECT_EQ(line_of_deep_key(parts(most_key_parts) + " = 1"), std::nullopt);
  for (const std::string part : {"a", "1", "\"a\"", "'='", "\"# \\\" [\"", "\"\""}) {
    for (const std::string dot : {".", " . ", "\t.\t"}) {
      EXPECT_EQ(line_of_deep_key(parts(most_key_parts, part, dot) + " = 1"), std::nullopt) << part << dot;
      EXPECT_EQ(line_of_deep_key("b = 1\n" + parts(most_key_parts + 1, part, dot) + " = 1"), 2)
          << part << dot;
    }
  }
  EXPECT_EQ(line_of_deep_key("[" + parts(most_key_parts + 1) + "]"), 1);
  EXPECT_EQ(line_of_deep_key("a = [\n{" + parts(most_key_parts + 1) + " = 1}]"), 2);
  EXPECT_EQ(line_of_deep_key("a = '''\n.\n'''\n" + parts(most_key_parts + 1)), 4);
}

TEST(KeyDepth, OfTextsCommentsAndNumbersIsNone) {
  const auto many = parts(3 * most_key_parts);
  for (const std::string& text : std::vector<std::string>{
           "a = \"" + many + "\"", "a = '" + many + "'", "a = \"\"\"\n" + many + "\n\"\"\"",
           "a = \"\\\"" + many + "\"", "a = '''" + many + "'''", "# " + many,
           "a = [" + parts(100, "1.5", ", ") + "]"}) {
    EXPECT_EQ(line_of_deep_key(text), std::nullopt) << text;
  }
  EXPECT_EQ(line_of_deep_key(full_case), std::nullopt);
}

TEST(KeyDepth, IsRefusedInAFileAndInAnAssignment) {
  EXPECT_EQ(refusal(least_case + parts(40) + " = 1\n"),
            "case.toml:9: a key of more than 32 parts; no key of a case has so many, remove it");
  for (const std::string part : {"a", "#", "'"}) {
    const auto assignment = parts(40, part) + "=1";
    EXPECT_EQ(refusal(least_case, {assignment}),
              "--set " + assignment + ": a key of more than 32 parts; no key of a case has so many");
  }
  EXPECT_THAT(refusal(least_case, {"flow={" + parts(40) + " = 1}"}),
              ::testing::HasSubstr("is not valid TOML"));
  EXPECT_EQ(refusal(least_case, {"title=" + parts(40)}), "");
}

}  // namespace
