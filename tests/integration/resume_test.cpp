// How a run goes on from its checkpoints, and that the advice of what it refuses works.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "tests/integration/resume_fixture.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(Resume, AKeyThatTheStateDoesNotDependOnMayChange) {
  run_half();
  const auto run = copy_of_half("out");
  const auto echo = run / "echo.toml";
  replace_in(echo, "title = \"Small capsule\"", "title = \"Another\"");
  replace_in(echo, "observables_every = 0.05", "observables_every = 0.02");
  replace_in(echo, "checkpoint_every = 0.1", "checkpoint_every = 0.05");
  replace_in(echo, "threads = 0", "threads = 1");
  const auto rows_before = read_file(run / "observables.csv");
  const auto ended = resume(run, {"--shear-time", "0.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  // What was written before stays, whatever the schedule has become: 0, 0.05 ... 0.3, then 0.32, 0.34 ...
  const auto rows = read_file(run / "observables.csv");
  EXPECT_TRUE(rows.starts_with(rows_before));
  EXPECT_EQ(std::ranges::count(rows, '\n'), 1 + 7 + 5);
  // And it can go on once more, from a checkpoint that the changed schedule has not met yet.
  replace_in(echo, "observables_every = 0.02", "observables_every = 0.15");
  ASSERT_EQ(resume(run, {"--shear-time", "0.42"}).exit_code, 0);
  replace_in(echo, "observables_every = 0.15", "observables_every = 0.02");
  const auto again = resume(run, {"--shear-time", "0.5"});
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_TRUE(read_file(run / "observables.csv").starts_with(rows));
}

TEST_F(Resume, FilesOfOthersInTheOutputStay) {
  run_half();
  const auto run = copy_of_half("out");
  write_file(run / "membrane/notes.txt", "mine");
  ASSERT_EQ(resume(run, {"--shear-time", "0.4"}).exit_code, 0);
  EXPECT_EQ(read_file(run / "membrane/notes.txt"), "mine");
}

TEST_F(Resume, GoesOnFromAnEarlierCheckpointAsTheMessagesSay) {
  run_half();
  run_whole();
  const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> broken = {
      {"damaged", [](const fs::path& run) { keep_half(run / "checkpoints/step_0000000180/fluid.vti"); }},
      {"rows", [](const fs::path& run) { keep_lines(run / "observables.csv", 1 + 5); }}};
  for (const auto& [name, break_it] : broken) {
    const auto run = copy_of_half(name);
    break_it(run);
    ASSERT_THAT(resume(run, {"--shear-time", "0.4"}).output, HasSubstr("with --from-step 120"));
    const auto ended = resume(run, {"--shear-time", "0.4", "--from-step", "120"});
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
    expect_same_results("whole", name);
    // The state of step 180 was written anew, in the place of the one that was set aside.
    EXPECT_TRUE(is_there(run, "step_0000000180"));
    EXPECT_FALSE(is_there(run, "set_aside_0000000180"));
    const auto further = resume(run, {"--shear-time", "0.4", "--from-step", "180"});
    ASSERT_EQ(further.exit_code, 0) << further.output;
    expect_same_results("whole", name);
  }
}

TEST_F(Resume, LaterCheckpointsAreSetAsideUntilNewOnesReplaceThem) {
  run_half();
  run_whole();
  const auto run = copy_of_half("out");
  // To step 150, which is before that of the checkpoint set aside.
  ASSERT_EQ(resume(run, {"--shear-time", "0.25", "--from-step", "120"}).exit_code, 0);
  EXPECT_TRUE(is_there(run, "set_aside_0000000180"));
  EXPECT_TRUE(is_there(run, "step_0000000150"));
  EXPECT_FALSE(is_there(run, "step_0000000180"));
  const auto no_such = resume(run, {"--from-step", "60"});
  EXPECT_THAT(no_such.output, HasSubstr("steps 120, 150, 180 (set aside)"));
  // The table was cut to step 150, so it does not reach that of step 180, as the refusal says.
  const auto back = resume(run, {"--shear-time", "0.4", "--from-step", "180"});
  EXPECT_EQ(back.exit_code, 2);
  EXPECT_THAT(back.output, HasSubstr("--from-step 150"));
  ASSERT_EQ(resume(run, {"--shear-time", "0.4"}).exit_code, 0);
  expect_same_results("whole", "out");
  EXPECT_FALSE(is_there(run, "set_aside_0000000180"));
}

TEST_F(Resume, ACheckpointThatWasSetAsideCanBeGoneOnFrom) {
  run_half();
  const auto run = copy_of_half("out");
  fs::rename(run / "checkpoints/step_0000000180", run / "checkpoints/set_aside_0000000180");
  const auto ended = resume(run, {"--shear-time", "0.35", "--from-step", "180"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_TRUE(is_there(run, "step_0000000180"));
  EXPECT_FALSE(is_there(run, "set_aside_0000000180"));
}

TEST_F(Resume, GoesOnWithoutRowsThatAreGone) {
  run_half();
  for (const int n_rows : {-1, 4}) {
    const auto run = copy_of_half("out");
    const auto table = run / "observables.csv";
    if (n_rows < 0) {
      fs::remove(table);
    } else {
      keep_lines(table, 1 + n_rows);
    }
    const auto ended = resume(run, {"--shear-time", "0.4", "--accept-gaps"});
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_EQ(std::ranges::count(read_file(table), '\n'), 1 + std::max(n_rows, 0) + 2);
    EXPECT_TRUE(fs::exists(run / "membrane/membrane_0000000150.vtu"));
    // The gap has been accepted once for all.
    const auto again = resume(run, {"--shear-time", "0.5"});
    EXPECT_EQ(again.exit_code, 0) << again.output;
  }
}

TEST_F(Resume, TheFixForWindowsLineEndsWorks) {
  run_half();
  run_whole();
  const auto run = copy_of_half("out");
  to_windows_line_ends(run / "observables.csv");
  const auto refused = resume(run, {"--shear-time", "0.4"}).output;
  const auto fix = refused.find("sed -i");
  ASSERT_NE(fix, std::string::npos);
  ASSERT_EQ(std::system(refused.substr(fix, refused.find('\n', fix) - fix).c_str()), 0);
  ASSERT_EQ(resume(run, {"--shear-time", "0.4"}).exit_code, 0);
  expect_same_results("whole", "out");
}

TEST_F(Resume, ARunOfTheChangedEchoIsTheOtherWay) {
  run_half();
  const auto run = copy_of_half("out");
  replace_in(run / "echo.toml", "wall_speed = 0.02", "wall_speed = 0.01");
  ASSERT_EQ(resume(run, {}).exit_code, 2);
  const auto ended = run_program({"run", (run / "echo.toml").string(), "--output",
                                  (directory_ / "new").string(), "--shear-time", "0.02"});
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
}

TEST_F(Resume, ACheckpointWithoutItsCaseIsTakenButSaidToBe) {
  run_half();
  run_whole();
  const auto run = copy_of_half("out");
  // As an earlier version wrote it.
  for (const char* file : {"echo.toml", "output.toml"})
    fs::remove(run / "checkpoints/step_0000000180" / file);
  const auto ended = resume(run, {"--shear-time", "0.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("does not hold its case"));
  expect_same_results("whole", "out");
  // Its table can be cut too.
  const auto other = copy_of_half("other");
  for (const char* file : {"echo.toml", "output.toml"})
    fs::remove(other / "checkpoints/step_0000000180" / file);
  keep_lines(other / "observables.csv", 1 + 5);
  EXPECT_THAT(resume(other, {"--shear-time", "0.4"}).output,
              AllOf(HasSubstr("holds 5 rows"), HasSubstr("--from-step 120")));
}

}  // namespace
