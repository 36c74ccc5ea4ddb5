// Whole runs of the program on a small capsule in shear flow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "tests/integration/run_fixture.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Run, WritesWhatItPromises) {
  const auto ended = run_program(run_to("out"));
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  for (const char* account :
       {"time of ", "\n  fluid ", "\n  forced nodes ", "\n  stencils ", "\n  interpolation ",
        "\n  spreading ", "\n  correction ", "\n  membranes ", "\n  files ", "\n  else "}) {
    EXPECT_THAT(ended.output, HasSubstr(account));
  }
  const auto last_line = ended.output.substr(ended.output.rfind('\n', ended.output.size() - 2) + 1);
  EXPECT_THAT(last_line, AllOf(StartsWith("ended at step 600 with "), HasSubstr("MLUPS; results are in")));
  const auto table = read_file(directory_ / "out/observables.csv");
  EXPECT_THAT(table,
              HasSubstr("step,shear_time,deformation,inclination_deg,length,width,breadth,volume_ratio,"
                        "area_ratio,elastic_energy,max_speed"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 21);  // header; 0, 0.05, ... 1.00
  for (const char* file :
       {"membrane.pvd", "membrane/membrane_0000000600.vtu", "fluid.pvd", "fluid/fluid_0000000300.vti",
        "echo.toml", "parameters.toml", "checkpoints/step_0000000600/fluid.vti"}) {
    EXPECT_TRUE(std::filesystem::exists(directory_ / "out" / file)) << file;
  }
  // The last two checkpoints are kept.
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out/checkpoints/step_0000000480"));
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/checkpoints/step_0000000540"));
}

TEST_F(Run, IsReproducedByItsEchoAndByAnyNumberOfThreads) {
  ASSERT_EQ(run_program(run_to("one", {"--threads", "1"})).exit_code, 0);
  const auto echo = (directory_ / "one/echo.toml").string();
  const auto ended = run_program({"run", echo, "--output", (directory_ / "again").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  expect_same_results("one", "again");
  ASSERT_EQ(run_program(run_to("three", {"--threads", "3"})).exit_code, 0);
  EXPECT_EQ(read_file(directory_ / "one/observables.csv"), read_file(directory_ / "three/observables.csv"));
  EXPECT_EQ(read_file(directory_ / "one/fluid/fluid_0000000600.vti"),
            read_file(directory_ / "three/fluid/fluid_0000000600.vti"));
}

TEST_F(Run, KilledAndResumedEqualsUninterrupted) {
  expect_killed_run_goes_on({});
}

TEST_F(Run, AViscousMembraneGoesOnBitForBitFromWithinAnInterval) {
  // 60 steps between checkpoints, 7 between updates: a checkpoint falls within an interval.
  expect_killed_run_goes_on(
      {"--set",
       "membrane.viscous={scheme = \"fd\", boussinesq_shear = 10, boussinesq_dilatational = 2, "
       "spring_stiffness = 50, interval = 7, strain_sampling = \"moving-average\"}"});
}

TEST_F(Run, ARunWithoutTheTangentialCorrectionGoesOnBitForBit) {
  // With it, which is the default, the force of its checkpoint is needed too.
  expect_killed_run_goes_on({"--set", "coupler.kernel=cosine4"});
}

TEST_F(Run, ACorrectedRunIsTheSameForAnyNumberOfThreadsAndNotThePlainOne) {
  ASSERT_EQ(run_program(run_to("plain", {"--set", "coupler.tangential_correction=false"})).exit_code, 0);
  ASSERT_EQ(run_program(run_to("one")).exit_code, 0);
  ASSERT_EQ(run_program(run_to("three", {"--threads", "3"})).exit_code, 0);
  const auto table = [&](const char* name) { return read_file(directory_ / name / "observables.csv"); };
  EXPECT_EQ(table("one"), table("three"));
  EXPECT_NE(table("one"), table("plain"));
}

TEST_F(Run, ShearTimeExtendsAFinishedRun) {
  ASSERT_EQ(run_program(run_to("long")).exit_code, 0);
  // 0.33 is on no schedule but that of the checkpoints' end: what it writes last must not stay in the longer
  // run.
  ASSERT_EQ(run_program(run_to("short", {"--shear-time", "0.33"})).exit_code, 0);
  const auto ended = run_program({"run", "--resume", (directory_ / "short").string(), "--shear-time", "1.0"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  expect_same_results("long", "short");
  const auto back = run_program({"run", "--resume", (directory_ / "short").string(), "--shear-time", "0.5"});
  EXPECT_EQ(back.exit_code, 2);
  EXPECT_THAT(back.output, HasSubstr("--shear-time 0.5"));
}

TEST_F(Run, NeverOverwritesWithoutForce) {
  const std::vector<std::string> brief = {"--shear-time", "0.05"};
  ASSERT_EQ(run_program(run_to("out", brief)).exit_code, 0);
  const auto before = result_files(directory_ / "out");
  const auto refused = run_program(run_to("out", brief));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("--force"), HasSubstr("--resume")));
  EXPECT_TRUE(before == result_files(directory_ / "out"));
  EXPECT_EQ(run_program(run_to("out", {"--shear-time", "0.05", "--force"})).exit_code, 0);
  // --force is no licence to clear a folder that holds something else.
  std::filesystem::create_directories(directory_ / "mine");
  std::ofstream(directory_ / "mine/thesis.txt") << "years of work";
  EXPECT_EQ(run_program(run_to("mine", {"--force"})).exit_code, 2);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "mine/thesis.txt"));
}

TEST_F(Run, BadInputLeavesNothingBehind) {
  const auto ended = run_program(run_to("out", {"--set", "flow.reynolds_nmber=1"}));
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("reynolds_nmber"), HasSubstr("reynolds_number")));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
  EXPECT_EQ(run_program({"run"}).exit_code, 2);
  EXPECT_EQ(run_program({"run", "--resume", (directory_ / "nowhere").string()}).exit_code, 2);
  EXPECT_EQ(run_program({"walk"}).exit_code, 2);
}

}  // namespace
