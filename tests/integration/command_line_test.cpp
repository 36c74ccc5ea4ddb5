// What the program says to command lines that it cannot use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/integration/program.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, AWordThatIsNoSubcommandIsNamed) {
  const auto near = run_program({"runn", "case.toml"});
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_THAT(near.output, HasSubstr("'runn' is no subcommand; did you mean run?"));
  EXPECT_THAT(run_program({"xyzzy"}).output,
              HasSubstr("'xyzzy' is no subcommand; tanktread --help lists them"));
}

TEST(CommandLine, ResumeWantsTheOutputOfARun) {
  const TemporaryDirectory directory;
  const auto ended = run_program({"run", "--resume", directory.path().string()});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("not the output of a run"));
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

}  // namespace
