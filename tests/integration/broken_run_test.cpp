// Runs that are stopped, killed, or go wrong: what they leave behind, and how they go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>

#include "tests/integration/run_fixture.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class BrokenRun : public Run {};

TEST_F(BrokenRun, SignalsEndItWithACheckpoint) {
  ASSERT_EQ(run_program(run_to("whole")).exit_code, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string name = "signal" + std::to_string(signal);
    const auto stopped = run_and_signal(run_to(name, {"--set", "run.checkpoint_every=100"}), signal, [&] {
      return read_file(directory_ / name / "observables.csv").size() > 1000;  // some steps are done
    });
    EXPECT_EQ(stopped.exit_code, 128 + signal) << stopped.output;
    EXPECT_TRUE(has_checkpoint_after(name, "0000000001"));
    ASSERT_EQ(run_program({"run", "--resume", (directory_ / name).string()}).exit_code, 0);
    EXPECT_EQ(read_file(directory_ / "whole/observables.csv"),
              read_file(directory_ / name / "observables.csv"));
  }
}

TEST_F(BrokenRun, BreakdownStopsWithTheLastGoodState) {
  const auto ended = run_program(run_to("out", {"--set", "flow.speed_limit=0.015"}));
  EXPECT_EQ(ended.exit_code, 3) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("step "), HasSubstr("velocity at node ("), HasSubstr("speed_limit, 0.015"),
                    HasSubstr("last good state: "), HasSubstr("checkpoints/step_")));
}

TEST_F(BrokenRun, SaysWhichProgramsMadeIt) {
  ASSERT_EQ(run_program(run_to("out", {"--shear-time", "0.1"})).exit_code, 0);
  const auto file = directory_ / "out/parameters.toml";
  const auto before = read_file(file);
  const auto at = before.find("commit = \"") + 10;
  const auto commit = before.substr(at, before.find('"', at) - at);
  std::string by_another = before;
  by_another.replace(at, commit.size(), "0123456789");
  std::ofstream(file) << by_another;
  ASSERT_EQ(run_program({"run", "--resume", (directory_ / "out").string(), "--shear-time", "0.2"}).exit_code,
            0);
  EXPECT_THAT(read_file(file), HasSubstr("commit = \"0123456789, " + commit));
}

TEST_F(BrokenRun, LeavesNothingOfAKilledProcessBehind) {
  ASSERT_EQ(run_program(run_to("whole", {"--shear-time", "0.4"})).exit_code, 0);
  ASSERT_EQ(run_program(run_to("cut", {"--shear-time", "0.2"})).exit_code, 0);
  // What a kill in the middle of writing leaves: half a file, half a checkpoint, a file not yet in its
  // series, half a row.
  std::ofstream(directory_ / "cut/.observables.csv.1-1.tmp") << "half";
  std::ofstream(directory_ / "cut/membrane/.membrane_0000000150.vtu.1-2.tmp") << "half";
  std::ofstream(directory_ / "cut/membrane/membrane_0000000133.vtu") << "orphan";
  std::filesystem::create_directories(directory_ / "cut/checkpoints/.step_0000000150.tmp");
  std::ofstream(directory_ / "cut/observables.csv", std::ios::app) << "121,0.2016";
  const auto ended = run_program({"run", "--resume", (directory_ / "cut").string(), "--shear-time", "0.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  expect_same_results("whole", "cut");
  EXPECT_FALSE(std::filesystem::exists(directory_ / "cut/checkpoints/.step_0000000150.tmp"));
}

TEST_F(BrokenRun, ResumeSaysWhatIsWrongWithItsFiles) {
  ASSERT_EQ(run_program(run_to("out", {"--shear-time", "0.2"})).exit_code, 0);
  const auto resume = [&] {
    return run_program({"run", "--resume", (directory_ / "out").string(), "--shear-time", "0.4"});
  };
  const auto fluid = directory_ / "out/checkpoints/step_0000000120/fluid.vti";
  const auto whole = read_file(fluid);
  std::ofstream(fluid, std::ios::binary) << whole.substr(0, whole.size() / 2);
  const auto damaged = resume();
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.output, AllOf(HasSubstr("fluid.vti"), HasSubstr("--from-step 60")));
  std::ofstream(fluid, std::ios::binary) << whole;
  std::filesystem::remove(directory_ / "out/observables.csv");
  const auto without_table = resume();
  EXPECT_EQ(without_table.exit_code, 2);
  EXPECT_THAT(without_table.output, HasSubstr("observables.csv"));
  std::filesystem::remove_all(directory_ / "out/checkpoints");
  EXPECT_EQ(resume().exit_code, 2);
}

TEST_F(BrokenRun, OneDirectoryIsForOneProcess) {
  Ended second;
  const auto first = run_and_signal(run_to("out", {"--shear-time", "50"}), SIGINT, [&] {
    if (!has_checkpoint_after("out", "0000000060")) return false;
    if (second.output.empty()) second = run_program({"run", "--resume", (directory_ / "out").string()});
    return true;
  });
  EXPECT_EQ(first.exit_code, 128 + SIGINT);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.output, HasSubstr("another tanktread process"));
}

/// No file of this process and its children can grow over a size while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(BrokenRun, ADiskThatIsFullInMidRunStopsItAndItGoesOnLater) {
  ASSERT_EQ(run_program(run_to("whole", {"--shear-time", "0.4"})).exit_code, 0);
  ASSERT_EQ(run_program(run_to("out", {"--shear-time", "0.2"})).exit_code, 0);
  const std::vector<std::string> go_on = {"run", "--resume", (directory_ / "out").string(), "--shear-time",
                                          "0.4"};
  {
    const FileSizeLimit limit(1000000);  // the next checkpoint holds 24^3 nodes of 19 doubles: 2.1 MB
    const auto ended = run_program(go_on);
    EXPECT_EQ(ended.exit_code, 3) << ended.output;
    EXPECT_THAT(ended.output, AllOf(HasSubstr("fluid.vti"), HasSubstr("last good state"),
                                    HasSubstr("checkpoints/step_0000000120")));
  }
  ASSERT_EQ(run_program(go_on).exit_code, 0);
  expect_same_results("whole", "out");
}

}  // namespace
