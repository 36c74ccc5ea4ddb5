// What the program says to command lines that it cannot use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "tests/integration/program.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, AWordThatIsNoSubcommandIsNamed) {
  const auto near = run_program({"runn", "case.toml"});
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_THAT(near.output, HasSubstr("'runn' is no subcommand; did you mean run?"));
  EXPECT_THAT(run_program({"xyzzy"}).output,
              HasSubstr("'xyzzy' is no subcommand; tanktread --help lists them"));
}

TEST(CommandLine, WhatIsMissingOrTooMuchIsSaidOfItsCommand) {
  const auto none = run_program({"coupler"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.output, HasSubstr("tanktread: error: tanktread coupler: "));
  EXPECT_THAT(none.output, HasSubstr("; see tanktread coupler --help"));
  EXPECT_THAT(run_program({"mesh", "sphere"}).output, HasSubstr("tanktread mesh sphere: file is required"));
  EXPECT_THAT(run_program({"diff", "a", "b", "--blindly"}).output, HasSubstr("see tanktread diff --help"));
  EXPECT_EQ(run_program({"coupler", "--help"}).exit_code, 0);
  EXPECT_EQ(run_program({"--version"}).exit_code, 0);
}

TEST(CommandLine, HelpHasTheWordsOfAChoiceAndNotTheirNumbers) {
  const auto help = run_program({"study", "twisting-sphere", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, HasSubstr("TEXT:{surface,flow}"));
  EXPECT_THAT(help.output, HasSubstr("TEXT:{rate-of-deformation,rate-of-strain}"));
  EXPECT_THAT(help.output, Not(HasSubstr("->")));
}

TEST(CommandLine, ResumeWantsTheOutputOfARun) {
  const TemporaryDirectory directory;
  const auto ended = run_program({"run", "--resume", directory.path().string()});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("not the output of a run"));
}

const std::string quick_case =
    "[flow]\nbox = [24, 24, 24]\nwall_speed = 0.03\n[[capsule]]\nradius = 5.0\nposition = [12.0, 12.0, "
    "12.0]\n"
    "mesh = { level = 1 }\n[membrane]\ncapillary_number = 0.3\n[run]\nshear_time = 0.02\nthreads = 1\n";

TEST(CommandLine, NumbersOfStepsThatNoRunCanHaveAreRefusedBeforeAnythingIsWritten) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  const auto case_file = (directory / "case.toml").string(), output = (directory / "output").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> all = {
      {{"--shear-time", "1e18"}, "run.shear_time = 1e+18"},
      {{"--shear-time", "nan"}, "--shear-time nan"},
      {{"--set", "flow.wall_speed=1e-300"}, "run.shear_time"},
      {{"--set", "membrane.viscous.interval=3000000000"}, "membrane.viscous.interval"},
      {{"--set", "output.fluid_box=[[0, 4294967297], [0, 1], [0, 1]]"}, "output.fluid_box"},
      {{"--threads", "99999999999"}, "--threads 99999999999"},
      {{"--record", (directory / "record").string(), "--from", "0x10"}, "--from 0x10"},
      {{"--record", (directory / "record").string(), "--to", "99999999999"}, "--to 99999999999"},
  };
  for (const auto& [more, message] : all) {
    std::vector<std::string> arguments = {"run", case_file, "--output", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << message;
    EXPECT_THAT(ended.output, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(output)) << message;
    EXPECT_FALSE(std::filesystem::exists(directory / "record")) << message;
  }
}

TEST(CommandLine, AnIntervalBeyondTheEndWritesTheStartAndTheEnd) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  const auto ended =
      run_program({"run", (directory / "case.toml").string(), "--output", (directory / "output").string(),
                   "--set", "output.membrane_every=1e18", "--set", "output.fluid_every=1e300"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  // 0.02 shear times of 400 steps.
  for (const std::string kind : {"membrane", "fluid"}) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory / "output" / kind))
      names.push_back(entry.path().stem().string());
    EXPECT_THAT(names, ::testing::UnorderedElementsAre(kind + "_0000000000", kind + "_0000000008"));
  }
}

TEST(CommandLine, AStepIsDecimalHoweverManyZerosItBeginsWith) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  const auto ended =
      run_program({"run", (directory / "case.toml").string(), "--output", (directory / "output").string(),
                   "--record", (directory / "record").string(), "--from", "0000000004", "--to", "08"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "record" / "grid_force"))
    names.push_back(entry.path().stem().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("grid_force_0000000005", "grid_force_0000000006",
                                                     "grid_force_0000000007", "grid_force_0000000008"));
  EXPECT_EQ(run_program({"mesh", "sphere", "--level", "010", (directory / "s.vtu").string()}).exit_code, 2);
}

TEST(CommandLine, AFullOutputDirectoryIsRefusedBeforeThePlan) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "mine.txt") << "keep";
  std::ofstream(directory / "case.toml")
      << "[flow]\nbox = [24, 24, 24]\nwall_speed = 0.02\n[[capsule]]\nradius = 5.0\n"
         "position = [12.0, 12.0, 12.0]\n[membrane]\ncapillary_number = 0.3\n";
  const auto ended =
      run_program({"run", (directory / "case.toml").string(), "--output", directory.path().string()});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, Not(HasSubstr("MLUPS")));
}

TEST(CommandLine, APlanSaysHowLargeAStepKeepsAnAccuracy) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml")
      << "[flow]\nbox = [44, 44, 44]\nwall_speed = 0.01\n[[capsule]]\nradius = 7.0\n"
         "position = [22.0, 22.0, 22.0]\n[membrane]\ncapillary_number = 0.3\n";
  const std::vector<std::string> plan = {"plan", (directory / "case.toml").string(), "--accuracy", "0.002"};
  const auto ended = run_program(plan);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.output, HasSubstr("accuracy 0.002: D within 0.2 % by the step at tau+ = 1 with --set "
                                      "flow.wall_speed="));
  for (const char* nonsense : {"0", "1e-22", "5"}) {
    auto refused = plan;
    refused.back() = nonsense;
    EXPECT_EQ(run_program(refused).exit_code, 2) << nonsense;
  }
}

TEST(CommandLine, APlanSaysWhatManyRanksWouldBe) {
  const TemporaryDirectory directory;
  const auto the_case = (directory / "case.toml").string();
  std::ofstream(the_case) << "[flow]\nbox = [44, 44, 44]\nwall_speed = 0.01\n[[capsule]]\nradius = 7.0\n"
                             "position = [22.0, 22.0, 22.0]\n[membrane]\ncapillary_number = 0.3\n";
  const auto ended = run_program({"plan", the_case, "--ranks", "8"});
  EXPECT_EQ(ended.exit_code, 0);
  for (const char* words : {"MLUPS", "on 8 ranks, by the model of docs/many-ranks.md", "1 x 2 x 4",
                            "44 x 22 x 11        10648 nodes", "of the first, more", "efficiency",
                            "       2  1 x 1 x 2               42592"})
    EXPECT_THAT(ended.output, HasSubstr(words));
  const std::pair<const char*, const char*> refused[] = {{"0", "--ranks"},
                                                         {"-1", "--ranks"},
                                                         {"two", "--ranks"},
                                                         {"100000000", "--ranks"},
                                                         {"47", "--ranks 47: a box of 44 x 44 x 44 nodes"}};
  for (const auto& [number, words] : refused) {
    const auto end = run_program({"plan", the_case, "--ranks", number});
    EXPECT_EQ(end.exit_code, 2) << number;
    EXPECT_THAT(end.output, AllOf(HasSubstr(words), Not(HasSubstr("MLUPS"))));
  }
}

// For a box of 8e9 nodes, a terabyte and more, which the plan with a trial refuses here.
TEST(CommandLine, APlanWithoutATrialSaysTheCostOfAnyBox) {
  const TemporaryDirectory directory;
  const auto the_case = (directory / "case.toml").string();
  std::ofstream(the_case)
      << "[flow]\nbox = [2000, 2000, 2000]\nwall_speed = 0.01\n[[capsule]]\nradius = 7.0\n"
         "position = [22.0, 22.0, 22.0]\n[membrane]\ncapillary_number = 0.3\n";
  const std::vector<std::string> plan = {"plan", the_case};
  const auto tried = run_program(plan);
  EXPECT_EQ(tried.exit_code, 2);
  EXPECT_THAT(tried.output, AllOf(HasSubstr("flow.box = [2000, 2000, 2000]"), HasSubstr("plan --no-trial")));
  const auto untried = run_program({"plan", the_case, "--no-trial"});
  EXPECT_EQ(untried.exit_code, 0) << untried.output;
  EXPECT_THAT(untried.output,
              AllOf(HasSubstr("not measured"), HasSubstr("not tried"), HasSubstr("2000 x 2000 x 2000"),
                    HasSubstr(" TB            at its peak"), Not(HasSubstr("MLUPS"))));
  const auto both = run_program({"plan", the_case, "--no-trial", "--ranks", "8"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, AllOf(HasSubstr("--no-trial"), HasSubstr("--ranks")));
}

TEST(CommandLine, AMessagesCommandLineIsQuotedForTheShell) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  const auto output = (directory / "my run").string();
  ASSERT_EQ(run_program({"run", (directory / "case.toml").string(), "--output", output}).exit_code, 0);
  const auto again = run_program({"run", (directory / "case.toml").string(), "--output", output});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.output, HasSubstr("--resume '" + output + "'"));
  std::filesystem::create_directory(directory / "no record");
  EXPECT_THAT(run_program({"replay", (directory / "no record").string(), "--only", "fluid"}).output,
              HasSubstr("--record '" + (directory / "no record").string() + "'"));
}

TEST(CommandLine, TheOutputOfARunMayBeCalledAsThatOfAStage) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  const auto case_file = (directory / "case.toml").string(), output = (directory / "output").string();
  const auto ended = run_program({"run", case_file, "--out", output});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_TRUE(std::filesystem::exists(directory / "output/observables.csv"));
  const auto twice = run_program({"run", case_file, "--out", output, "--output", output + "_too"});
  EXPECT_EQ(twice.exit_code, 2) << twice.output;
  EXPECT_FALSE(std::filesystem::exists(output + "_too"));
  EXPECT_THAT(run_program({"run", "--resume", output, "--out", output + "_too"}).output,
              HasSubstr("--output"));
}

TEST(CommandLine, AMeshOfAnotherFormatIsToldTheConversion) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "cell.stl") << "solid cell\nendsolid cell\n";
  std::ofstream(directory / "case.toml") << quick_case;
  const auto ended =
      run_program({"run", (directory / "case.toml").string(), "--output", (directory / "output").string(),
                   "--set", "capsule.0.mesh={file=\"cell.stl\"}"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("is an STL file, not a surface (.vtu); convert it: python3 -m "
                                      "tanktread_post convert-surface "));
  EXPECT_FALSE(std::filesystem::exists(directory / "output"));
}

#ifndef __SANITIZE_ADDRESS__  // which maps more than any limit
TEST(CommandLine, MemoryThatEndsIsSaidSo) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << quick_case;
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  // Of addresses, not of what the machine has, so that it shows when the memory is asked for only.
  const rlimit half_a_gigabyte{500'000'000, before.rlim_max};
  setrlimit(RLIMIT_AS, &half_a_gigabyte);
  const auto ended = run_program({"fluid", "--case", (directory / "case.toml").string(), "--set",
                                  "flow.box=[160, 160, 160]", "--out", (directory / "out.vti").string()});
  setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(ended.exit_code, 3) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("the memory is not enough"));
  EXPECT_THAT(ended.output, Not(HasSubstr("bad_alloc")));
}
#endif

}  // namespace
