// Two cases compared key by key, over the whole schema.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "driver/case/case_difference.hpp"
#include "driver/case/said_value.hpp"
#include "tests/unit/case_samples.hpp"
#include "tests/unit/key_values.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> paths_of(const std::vector<KeyDifference>& differences) {
  std::vector<std::string> paths;
  for (const auto& d : differences) paths.push_back(d.path);
  return paths;
}

/// Cases in one of which each key has a place: dimensionless and SI, walls and none, a mesh from a file.
std::vector<Case> samples() {
  std::vector<Case> cases;
  for (const auto& text : {least_case, full_case, droplet_case, si_case}) cases.push_back(parse(text));
  cases.push_back(cases.front());
  cases.back().capsules[0].mesh.file = "/somewhere/cell.vtu";
  cases.back().capsules[0].stress_free.file = "/somewhere/stress-free.vtu";
  for (const auto& number : {"aspect_ratio = 0.3", "reduced_volume = 0.7"}) {
    const auto spheroid = std::string("={shape = \"spheroid\", ") + number + "}";
    cases.push_back(parse(least_case, {"capsule.0.mesh" + spheroid, "capsule.0.stress_free" + spheroid,
                                       "capsule.0.mesh.direction=[1, 2, 3]"}));
  }
  cases.push_back(cases.front());
  cases.back().capsules[0].membrane.elastic_law = "hookean";
  cases.push_back(cases.front());
  cases.back().capsules[0].membrane.viscous.scheme = "implicit";
  return cases;
}

/// The same case with another value of the key, which has a place in both; nothing where it has none.
std::optional<Case> changed(const Case& the_case, const Key& key) {
  if (key.path.starts_with("si.") && !the_case.si) return std::nullopt;
  if (!has_place(key, the_case, 0)) return std::nullopt;
  auto other = the_case;
  key.set(other, 0, another_value(key));
  if (key.get(other, 0) == key.get(the_case, 0) || !has_place(key, other, 0)) return std::nullopt;
  return other;
}

TEST(CaseDifference, OnlyTheseKeysMayChangeWhenARunGoesOn) {
  const std::set<std::string> free = {"title",
                                      "capsule.N.mesh.file",  // the path; what it holds is in file_hash
                                      "capsule.N.stress_free.file",
                                      "coupler.implicit_iterations",
                                      "run.shear_time",
                                      "run.threads",
                                      "run.ranks",
                                      "run.message_latency_us",
                                      "run.message_bandwidth_GB_s",
                                      "run.checkpoint_every",
                                      "run.checkpoint_minutes",
                                      "run.command_time_limit",
                                      "run.command_directory",
                                      "output.observables_every",
                                      "output.measures_every",
                                      "output.energy_every",
                                      "output.membrane_every",
                                      "output.fluid_every",
                                      "output.fluid_box",
                                      "output.whole_file_nodes",
                                      "output.whole_file_triangles"};
  std::set<std::string> found;
  for (const auto& key : schema()) {
    if (key.may_change_on_resume) found.insert(key.path);
  }
  EXPECT_EQ(found, free);
}

TEST(CaseDifference, EveryKeyThatIsChangedIsNamedAndRefusedUnlessItMayChange) {
  for (const auto& key : schema()) {
    int n_tried = 0;
    for (const auto& the_case : samples()) {
      const auto other = changed(the_case, key);
      if (!other) continue;
      ++n_tried;
      const auto found = differences(the_case, *other);
      const auto lines = lines_of_fixed_keys(found, "the checkpoint", "echo.toml");
      // A key of [membrane] is named there if all capsules share it, else as that capsule's own.
      const auto own = numbered_path(key.path, 0);
      const auto shared = own.starts_with("capsule.0.membrane.") ? own.substr(10) : "capsule.0." + own;
      const auto paths = paths_of(found);
      EXPECT_TRUE(std::ranges::find(paths, own) != paths.end() ||
                  std::ranges::find(paths, shared) != paths.end())
          << key.path;
      EXPECT_EQ(lines.empty(), key.may_change_on_resume) << key.path << ": " << lines;
    }
    EXPECT_GT(n_tried, 0) << key.path << " has a place in no sample: give it one";
  }
}

TEST(CaseDifference, NothingDiffersFromItselfReadFromItsEcho) {
  for (const auto& the_case : samples()) {
    EXPECT_THAT(differences(the_case, the_case), ElementsAre());
    const auto echo = parse_case(to_toml(the_case), "echo.toml", "/elsewhere", {}, {false, false, false});
    EXPECT_THAT(paths_of(differences(the_case, echo)), ElementsAre());
  }
}

TEST(CaseDifference, SaysBothValuesAndWhereTheyAre) {
  const auto found = differences(parse(least_case), parse(least_case, {"membrane.capillary_number=0.2"}));
  EXPECT_EQ(lines_of_fixed_keys(found, "the checkpoint", "echo.toml"),
            "  membrane.capillary_number: 0.3 in the checkpoint, 0.2 in echo.toml");
  const auto gone = differences(parse(least_case, {"flow.speed_limit=0.2"}), parse(least_case));
  EXPECT_THAT(lines_of_fixed_keys(gone, "A", "B"), HasSubstr("flow.speed_limit: 0.2 in A, not given in B"));
}

TEST(CaseDifference, ACapsulesOwnKeyIsNamedWithItsNumber) {
  const auto found =
      differences(parse(full_case), parse(full_case, {"capsule.1.membrane.poisson_ratio=0.1"}));
  EXPECT_THAT(paths_of(found), ElementsAre("capsule.1.membrane.poisson_ratio"));
  auto third = parse(full_case);
  third.capsules.push_back(third.capsules[0]);
  const auto more = differences(parse(full_case), third);
  ASSERT_EQ(more.size(), 1U);
  EXPECT_THAT(lines_of_fixed_keys(more, "A", "B"), HasSubstr("[[capsule]]: 2 in A, 3 in B"));
}

}  // namespace
