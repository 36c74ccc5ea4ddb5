// The table of keys, by itself and against the manual.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "driver/case/schema.hpp"
#include "driver/case/spelling.hpp"
#include "tests/unit/case_samples.hpp"
#include "tests/unit/key_values.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;

std::string manual() {
  const auto file = std::filesystem::path(TANKTREAD_SOURCE) / "docs/case-file.md";
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Case two_capsules() {
  Case the_case;
  the_case.capsules.resize(2);
  return the_case;
}

TEST(Schema, KeysAreUniqueAndExplained) {
  std::set<std::string> paths;
  for (const auto& key : schema()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path << " stands twice";
    EXPECT_FALSE(key.meaning.empty()) << key.path;
    EXPECT_EQ(key.meaning.find('\n'), std::string::npos) << key.path;
    EXPECT_NE(key.kind, Kind::none) << key.path;
    EXPECT_EQ(find_key(numbered_path(key.path, 12)), &key) << key.path;
  }
}

TEST(Schema, EachKeyIsItsOwnMemberOfTheCase) {
  for (const auto& key : schema()) {
    auto the_case = two_capsules();
    key.set(the_case, 1, another_value(key));
    EXPECT_TRUE(key.get(the_case, 1) == another_value(key)) << key.path;
    for (const auto& other : schema()) {
      // [membrane] and a capsule's own table are the same members; the default density comes with [si].
      const bool is_same = numbered_path("capsule.N." + other.path, 0) == numbered_path(key.path, 0) ||
                           numbered_path("capsule.N." + key.path, 0) == numbered_path(other.path, 0);
      const bool is_si = key.path.starts_with("si.") && other.path.starts_with("si.");
      if (&other == &key || is_same || is_si) continue;
      EXPECT_TRUE(other.get(the_case, 1) == other.get(two_capsules(), 1))
          << key.path << " changes " << other.path;
    }
    if (!key.path.starts_with("capsule.") && !key.path.starts_with("membrane.")) continue;
    EXPECT_TRUE(key.get(the_case, 0) == key.get(two_capsules(), 0)) << key.path << " changes capsule 0";
  }
}

TEST(Schema, EachSiKeyIsItsOwnMember) {
  for (const auto& key : schema()) {
    if (!key.path.starts_with("si.")) continue;
    Case the_case, untouched;
    the_case.si.emplace();
    untouched.si.emplace();
    key.set(the_case, 0, 0.625);
    for (const auto& other : schema()) {
      if (!other.path.starts_with("si.")) continue;
      EXPECT_EQ(other.get(the_case, 0) == other.get(untouched, 0), &other != &key)
          << key.path << " and " << other.path;
    }
  }
}

TEST(Schema, TheManualsTableIsTheSchema) {
  EXPECT_THAT(manual(), HasSubstr(schema_markdown()))
      << "docs/case-file.md is behind the schema: put this table there";
}

TEST(Schema, TheManualsExamplesAreCases) {
  std::istringstream lines(manual());
  std::string example;
  int n_examples = 0;
  bool is_example = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```toml") {
      is_example = true;
      example.clear();
    } else if (is_example && line == "```") {
      is_example = false;
      ++n_examples;
      EXPECT_EQ(refusal(example), "") << example;
    } else if (is_example) {
      example += line + "\n";
    }
  }
  EXPECT_GE(n_examples, 4);
}

TEST(Schema, PathsOfCapsules) {
  EXPECT_EQ(general_path("capsule.12.mesh.level"), "capsule.N.mesh.level");
  EXPECT_EQ(general_path("capsule.3"), "capsule.N");
  EXPECT_EQ(general_path("capsule.3x.radius"), "capsule.3x.radius");
  EXPECT_EQ(general_path("flow.box"), "flow.box");
  EXPECT_EQ(numbered_path("capsule.N.radius", 2), "capsule.2.radius");
  EXPECT_EQ(numbered_path("flow.box", 2), "flow.box");
}

TEST(Schema, AllowedText) {
  EXPECT_EQ(allowed_text(*find_key("flow.relaxation_time")), "a number > 0.5");
  EXPECT_EQ(allowed_text(*find_key("flow.collision")), "one of \"trt\", \"bgk\"");
  EXPECT_EQ(allowed_text(*find_key("flow.box")), "three integers >= 4 and <= 100000");
  EXPECT_EQ(allowed_text(*find_key("capsule.0.mesh.level")), "an integer >= 0 and <= 8");
  EXPECT_EQ(allowed_text(*find_key("membrane.poisson_ratio")), "a number > -1 and < 1");
  EXPECT_EQ(allowed_text(*find_key("flow.inertia")), "true or false");
  EXPECT_EQ(allowed_text(*find_key("membrane.command")), "a list of texts");
}

TEST(Spelling, NearestIsFoundAndFarIsNot) {
  const std::vector<std::string> words = {"skalak", "neo-hookean", "hookean"};
  EXPECT_EQ(nearest_spelling("skalk", words), "skalak");    // left out
  EXPECT_EQ(nearest_spelling("skkalak", words), "skalak");  // put in
  EXPECT_EQ(nearest_spelling("sklaak", words), "skalak");   // swapped: one step, not two
  EXPECT_EQ(nearest_spelling("SKALAK", words), "skalak");   // capitals
  EXPECT_EQ(nearest_spelling("hokean", words), "hookean");  // the nearer of two
  EXPECT_EQ(nearest_spelling("xyzzyq", words), "");
  EXPECT_EQ(nearest_spelling("x", {"y"}), "y");       // one letter may always be wrong
  EXPECT_EQ(nearest_spelling("fxxw", {"flow"}), "");  // two of four is too far
}

TEST(Spelling, SimilarPaths) {
  EXPECT_EQ(similar_path("flow.reynolds_nmber"), "flow.reynolds_number");
  EXPECT_EQ(similar_path("flwo"), "flow");
  EXPECT_EQ(similar_path("membrane.viscuous"), "membrane.viscous");
  EXPECT_EQ(similar_path("kernel"), "coupler.kernel");  // right name, wrong table
  EXPECT_EQ(similar_path("capsule.1.raduis"), "capsule.N.radius");
  EXPECT_EQ(similar_path("flow.completely_different"), "");
}

}  // namespace
