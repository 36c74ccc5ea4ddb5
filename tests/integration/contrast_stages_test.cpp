// The stages, records and resumes of a run whose capsules have another fluid inside: bit for bit the run.
#include <cmath>

#include "exchange/vtk_files.hpp"
#include "tests/integration/contrast_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::HasSubstr;

class ContrastRun : public Contrast, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    Contrast::SetUp();
    if (GetParam()) correct();
  }
  /// How many nodes come into a capsule, or go out, in recorded steps. Without any a test would say little.
  double changes(int first, int last) const {
    double sum = 0;
    for (int step = first; step <= last; ++step) {
      const auto file = exchange::read_grid(path("record/inside/" + numbered("inside", step) + ".vti"));
      for (const double touched : exchange::find_array(file.point_data, "touched", "inside").values)
        sum += touched;
    }
    return sum;
  }
};
INSTANTIATE_TEST_SUITE_P(Stages, ContrastRun, ::testing::Bool(), name_of_correction);

TEST_P(ContrastRun, StagedEqualsFused) {
  constexpr int n_steps = 5;
  call({"run", path("case.toml"), "--output", path("out"), "--record", path("record"), "--to",
        std::to_string(n_steps)});
  EXPECT_GT(changes(1, n_steps), 0);
  stage({"membrane", "--out", path("membrane.vtu")});
  stage({"coupler", "mark", "--in", path("membrane.vtu"), "--out", path("inside.vti")});
  stage({"fluid", "--steps", "0", "--inside", path("inside.vti"), "--out", path("fluid.vti"), "--fields",
         path("flow.vti"), "--free", path("free.vti")});
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/begin/fluid.vti")));
  for (int step = 0; step < n_steps; ++step) {
    stage({"coupler", "interpolate", "--in", path("membrane.vtu"), "--grid", path("flow.vti"), "--out",
           path("velocity.vtu")});
    stage({"membrane", "--in", path("velocity.vtu"), "--move", "--state", path("membrane.vtu"), "--out",
           path("elastic.vtu")});
    stage(
        {"implicit", "--in", path("elastic.vtu"), "--grid", path("free.vti"), "--out", path("membrane.vtu")});
    stage({"coupler", "spread", "--in", path("membrane.vtu"), "--out", path("force.vti")});
    stage({"coupler", "mark", "--in", path("membrane.vtu"), "--out", path("inside.vti")});
    stage({"fluid", "--state", path("fluid.vti"), "--force", path("force.vti"), "--inside",
           path("inside.vti"), "--out", path("fluid.vti"), "--fields", path("flow.vti"), "--free",
           path("free.vti")});
  }
  EXPECT_TRUE(values(path("flow.vti"), "inside") == values(path("inside.vti"), "inside"));
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/end/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/end/fluid.vti")));
}

TEST_P(ContrastRun, ThroughFilesEqualsInMemory) {
  call({"run", path("case.toml"), "--output", path("memory")});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  EXPECT_TRUE(std::filesystem::exists(path("files/packets/inside.vti")));
  std::filesystem::remove_all(path("files/packets"));
  EXPECT_EQ(result_files(path("memory")), result_files(path("files")));
  expect_same_end("memory", "files");
}

TEST_P(ContrastRun, IsReplayedComponentByComponent) {
  record(3);
  EXPECT_GT(changes(4, contrast_steps), 0);
  for (const char* component : {"membrane", "implicit", "coupler", "fluid"}) {
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 9 steps"))
        << component;
  }
}

TEST_P(ContrastRun, GoesOnBitForBitFromACheckpointInTheMiddle) {
  call({"run", path("case.toml"), "--output", path("whole")});
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.04"});
  for (const std::string step : {"5", "10"}) {
    call({"run", "--resume", path("half"), "--shear-time", "0.048", "--from-step", step});
    const auto whole = result_files(path("whole")), half = result_files(path("half"));
    ASSERT_EQ(whole.size(), half.size());
    for (std::size_t k = 0; k < whole.size(); ++k) {
      EXPECT_EQ(whole[k].first, half[k].first);
      EXPECT_TRUE(whole[k].second == half[k].second) << whole[k].first << " after " << step;
    }
    expect_same_end("whole", "half");
  }
}

TEST_P(ContrastRun, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const std::string threads : {"1", "2", "3"})
    call({"run", path("case.toml"), "--output", path(threads), "--threads", threads, "--shear-time", "0.02"});
  for (const std::string threads : {"2", "3"}) expect_same_end("1", threads, 5);
}

TEST_F(Contrast, FieldsHaveTheMarksOnlyWhereTheyAreKnownOfAllNodes) {
  call({"run", path("case.toml"), "--output", path("out"), "--record", path("record")});
  const std::vector<std::string> no_marks,
      some = {"--inside", path("record/inside/" + numbered("inside", 6) + ".vti")};
  for (const auto& marks : {no_marks, some}) {
    std::vector<std::string> words = {"fluid",           "--state",  path("record/begin/fluid.vti"),
                                      "--steps",         "0",        "--out",
                                      path("fluid.vti"), "--fields", path("flow.vti")};
    words.insert(words.end(), marks.begin(), marks.end());
    stage(words);
    EXPECT_FALSE(has(path("flow.vti"), "inside")) << words.size();
  }
}

// Its first marks are news against those of the checkpoint, not against a fluid without capsules: else a node
// that a capsule leaves in that step would keep the viscosity.
TEST_F(Contrast, TheRecordOfAResumedRunIsTheSame) {
  record(10);
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.04"});
  call({"run", "--resume", path("half"), "--shear-time", "0.048", "--record", path("again"), "--from", "10"});
  EXPECT_THAT(call({"diff", path("record"), path("again")}), HasSubstr("identical"));
}

TEST_F(Contrast, AWrongMarkOfARecordIsFound) {
  record(3);
  const auto packet = path("record/inside/" + numbered("inside", 7) + ".vti");
  auto grid = exchange::read_grid(packet);
  auto& marks = grid.point_data[0].values;
  auto& touched = grid.point_data[1].values;
  const auto node = static_cast<std::size_t>(6 + 26 * (7 + 16 * 8));  // beside the centre of capsule 0
  ASSERT_EQ(grid.point_data[0].name, "inside");
  ASSERT_EQ(marks[node], 1);
  marks[node] = 2;
  touched[node] = 1;
  exchange::write_grid(packet, grid);
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}, 1),
              HasSubstr("different: step 7, packet inside, array inside"));
  // The velocity does not ask for the viscosity of its node, but is told from what the node has sent out,
  // rounded.
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid"}, 1),
              HasSubstr("different: step 8, packet grid_velocity"));
}

TEST_F(Contrast, ARecordWithoutAnEndEndsWithItsLastMarks) {
  record(3);
  std::filesystem::remove_all(path("record/end"));
  std::filesystem::remove(path("record/inside/" + numbered("inside", contrast_steps) + ".vti"));
  for (const char* component : {"coupler", "fluid"})
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 8 steps"));
}

// Other viscosities are those of the whole fluid, from the first step of the replay on: as if the state had
// begun so.
TEST_F(Contrast, OtherViscositiesOfAReplayAreThoseOfAllNodes) {
  correct();
  record(9);
  const std::vector<std::string> other = {"--set", "flow.relaxation_time=0.9",
                                          "--set", "capsule.0.viscosity_ratio=1",
                                          "--set", "capsule.1.viscosity_ratio=1"};
  std::vector<std::string> replay = {"replay", path("record"), "--only",
                                     "fluid",  "--out",        path("difference")};
  replay.insert(replay.end(), other.begin(), other.end());
  call(replay);
  auto state = exchange::read_grid(path("record/begin/fluid.vti"));
  EXPECT_EQ(std::erase_if(state.point_data, [](const auto& array) { return array.name == "viscosity"; }), 1U);
  exchange::write_grid(path("fluid.vti"), state);
  for (const int step : {10, 11}) {
    std::vector<std::string> arguments = {"fluid",
                                          "--state",
                                          path("fluid.vti"),
                                          "--force",
                                          path("record/grid_force/" + numbered("grid_force", step) + ".vti"),
                                          "--out",
                                          path("fluid.vti"),
                                          "--fields",
                                          path("flow.vti")};
    arguments.insert(arguments.end(), other.begin(), other.end());
    stage(arguments);
  }
  const auto expected = exchange::read_grid(path("flow.vti"));
  const auto replayed =
      exchange::read_grid(path("difference/grid_velocity/" + numbered("grid_velocity", 12) + ".vti"));
  EXPECT_TRUE(exchange::find_array(expected.point_data, "velocity", "flow").values ==
              exchange::find_array(replayed.point_data, "replayed_velocity", "difference").values);
}

TEST_F(Contrast, AContrastOfARecordWithoutOneIsRefused) {
  std::vector<std::string> arguments = {"run",      path("case.toml"), "--output", path("out"),
                                        "--record", path("record"),    "--from",   "9"};
  arguments.insert(arguments.end(), no_contrast.begin(), no_contrast.end());
  call(arguments);
  for (const char* component : {"coupler", "fluid"})
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 3 steps"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid", "--set", "capsule.0.viscosity_ratio=2"}, 2),
              HasSubstr("holds no packets inside"));
}

}  // namespace
}  // namespace tanktread::testing
