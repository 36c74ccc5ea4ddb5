// Whole runs of the program on a small capsule in shear flow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "tests/integration/program.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

/// 24^3 nodes, shear rate 2 * 0.02/24, so 600 steps a shear time.
constexpr const char* small_case = R"(
title = "Small capsule"
[flow]
kind = "shear"
box = [24, 24, 24]
wall_speed = 0.02
relaxation_time = 1.0
[[capsule]]
radius = 5.0
position = [12.0, 12.0, 12.0]
mesh = { shape = "sphere", level = 2 }
[membrane]
elastic_law = "skalak"
capillary_number = 0.3
[run]
shear_time = 1.0
checkpoint_every = 0.1
[output]
observables_every = 0.05
membrane_every = 0.25
fluid_every = 0.5
)";

class Run : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(case_file_) << small_case; }

  std::vector<std::string> run_to(const std::string& name, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"run", case_file_.string(), "--output",
                                          (directory_ / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  void expect_same_results(const std::string& first, const std::string& second) const {
    const auto a = result_files(directory_ / first), b = result_files(directory_ / second);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].first, b[k].first);
      EXPECT_TRUE(a[k].second == b[k].second) << a[k].first << " differs";
    }
  }

  bool has_checkpoint_after(const std::string& name, const std::string& step) const {
    const auto folder = directory_ / name / "checkpoints";
    if (!std::filesystem::is_directory(folder)) return false;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename().string() >= "step_" + step && entry.path().filename().string()[0] == 's')
        return true;
    }
    return false;
  }

  void expect_killed_run_goes_on(const std::vector<std::string>& more) const {
    ASSERT_EQ(run_program(run_to("whole", more)).exit_code, 0);
    const auto killed = run_and_signal(run_to("killed", more), SIGKILL,
                                       [&] { return has_checkpoint_after("killed", "0000000240"); });
    ASSERT_EQ(killed.exit_code, 128 + SIGKILL) << "the run ended before it was killed";
    const auto resumed = run_program({"run", "--resume", (directory_ / "killed").string()});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
    expect_same_results("whole", "killed");
  }

  TemporaryDirectory directory_;
  std::filesystem::path case_file_ = directory_ / "small.toml";
};

TEST_F(Run, WritesWhatItPromises) {
  const auto ended = run_program(run_to("out"));
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("MLUPS; results are in"), HasSubstr("cost: fluid")));
  const auto table = read_file(directory_ / "out/observables.csv");
  EXPECT_THAT(table,
              HasSubstr("step,shear_time,deformation,inclination_deg,length,width,breadth,volume_ratio,"
                        "area_ratio,elastic_energy,max_speed"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 21);  // header; 0, 0.05, ... 1.00
  for (const char* file :
       {"membrane.pvd", "membrane/membrane_0000000600.vtu", "fluid.pvd", "fluid/fluid_0000000300.vti",
        "echo.toml", "checkpoints/step_0000000600/fluid.vti"}) {
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

TEST_F(Run, SignalsEndItWithACheckpoint) {
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

TEST_F(Run, BreakdownStopsWithTheLastGoodState) {
  const auto ended = run_program(run_to("out", {"--set", "flow.speed_limit=0.015"}));
  EXPECT_EQ(ended.exit_code, 3) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("step "), HasSubstr("velocity at node ("), HasSubstr("limit of 0.015"),
                    HasSubstr("last good state: "), HasSubstr("checkpoints/step_")));
}

TEST_F(Run, LeavesNothingOfAKilledProcessBehind) {
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

TEST_F(Run, ResumeSaysWhatIsWrongWithItsFiles) {
  ASSERT_EQ(run_program(run_to("out", {"--shear-time", "0.2"})).exit_code, 0);
  const auto resume = [&] {
    return run_program({"run", "--resume", (directory_ / "out").string(), "--shear-time", "0.4"});
  };
  const auto fluid = directory_ / "out/checkpoints/step_0000000120/fluid.vti";
  const auto whole = read_file(fluid);
  std::ofstream(fluid, std::ios::binary) << whole.substr(0, whole.size() / 2);
  const auto damaged = resume();
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.output, AllOf(HasSubstr("fluid.vti"), HasSubstr("remove it to go on from"),
                                    HasSubstr("step_0000000060")));
  std::ofstream(fluid, std::ios::binary) << whole;
  std::filesystem::remove(directory_ / "out/observables.csv");
  const auto without_table = resume();
  EXPECT_NE(without_table.exit_code, 0);
  EXPECT_THAT(without_table.output, HasSubstr("observables.csv"));
  std::filesystem::remove_all(directory_ / "out/checkpoints");
  EXPECT_EQ(resume().exit_code, 2);
}

TEST_F(Run, OneDirectoryIsForOneProcess) {
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

TEST_F(Run, AWriteThatFailsStopsWithTheLastGoodState) {
  ASSERT_EQ(run_program(run_to("out", {"--shear-time", "0.2"})).exit_code, 0);
  std::filesystem::remove_all(directory_ / "out/membrane");
  std::ofstream(directory_ / "out/membrane") << "a file where the folder should be";
  const auto ended = run_program({"run", "--resume", (directory_ / "out").string(), "--shear-time", "0.4"});
  EXPECT_EQ(ended.exit_code, 3) << ended.output;
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

TEST_F(Run, ADiskThatIsFullInMidRunStopsItAndItGoesOnLater) {
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

TEST(Program, HelpAndVersionOnEveryLevel) {
  EXPECT_EQ(run_program({"--version"}).exit_code, 0);
  EXPECT_THAT(run_program({"--version"}).output, MatchesRegex("tanktread [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  for (const auto& command : std::vector<std::vector<std::string>>{{},
                                                                   {"run"},
                                                                   {"plan"},
                                                                   {"mesh"},
                                                                   {"mesh", "sphere"},
                                                                   {"mesh", "info"},
                                                                   {"study"},
                                                                   {"study", "maxwell"},
                                                                   {"study", "strain-rate-noise"},
                                                                   {"study", "twisting-sphere"}}) {
    auto arguments = command;
    arguments.push_back("--help");
    const auto ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("--help"));
  }
}

TEST(Program, StudiesComponents) {
  const TemporaryDirectory directory;
  const auto file = (directory / "errors.csv").string();
  const auto study = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "study");
    arguments.insert(arguments.end(), {"--out", file});
    return run_program(arguments);
  };
  ASSERT_EQ(study({"maxwell", "--scheme", "fd", "int1", "--k", "1", "2", "--dt", "6", "5"}).exit_code, 0);
  const auto table = read_file(file);
  EXPECT_THAT(table, AllOf(HasSubstr("scheme,viscosity,stiffness"), HasSubstr("\nint1,100,2,600,5,")));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 8);
  ASSERT_EQ(study({"strain-rate-noise", "--interval", "3"}).exit_code, 0);
  EXPECT_THAT(read_file(file), HasSubstr("cosine4,100,0,3,"));
  ASSERT_EQ(
      study({"twisting-sphere", "--level", "1", "--period", "8", "--angle", "0", "30", "--kernel", "roma3"})
          .exit_code,
      0);
  EXPECT_THAT(read_file(file), AllOf(HasSubstr("\nsurface,80,20,0 0 1,30,,int2,0.75,theta-phi,"),
                                     HasSubstr("\nflow,80,20,0 0 1,0,roma3,fd,0.25,phi-phi,")));
  for (const auto& wrong : std::vector<std::vector<std::string>>{{"maxwell", "--scheme", "rk4"},
                                                                 {"maxwell", "--k", "-1"},
                                                                 {"strain-rate-noise", "--interval", "0"},
                                                                 {"twisting-sphere", "--approach", "walk"},
                                                                 {"twisting-sphere", "--radius", "0"}}) {
    EXPECT_EQ(study(wrong).exit_code, 2) << wrong[0] << " " << wrong[2];
  }
  EXPECT_EQ(run_program({"study", "maxwell", "--out", (directory / "none/errors.csv").string()}).exit_code,
            2);
  EXPECT_EQ(run_program({"study", "maxwell"}).exit_code, 2);
}

TEST(Program, MakesAndInspectsMeshes) {
  const TemporaryDirectory directory;
  const auto file = (directory / "sphere.vtu").string();
  ASSERT_EQ(run_program({"mesh", "sphere", "--level", "2", "--radius", "19.1", file}).exit_code, 0);
  const auto info = run_program({"mesh", "info", file});
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.output,
              AllOf(HasSubstr("triangles           320"), HasSubstr("a membrane can be made of it")));
  EXPECT_EQ(run_program({"mesh", "sphere", "--level", "99", file}).exit_code, 2);
  EXPECT_EQ(run_program({"mesh", "info", (directory / "none.vtu").string()}).exit_code, 2);
  EXPECT_EQ(run_program({"mesh", "sphere", (directory / "none/sphere.vtu").string()}).exit_code, 2);
}

}  // namespace
