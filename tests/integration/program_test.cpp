// The program's commands without a run: help, studies, meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/program.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(Program, HelpAndVersionOnEveryLevel) {
  EXPECT_EQ(run_program({"--version"}).exit_code, 0);
  EXPECT_THAT(run_program({"--version"}).output,
              MatchesRegex("tanktread [0-9]+\\.[0-9]+\\.[0-9]+ \\(commit ([0-9a-f]+[+]?|unknown)\\)\n"));
  for (const auto& command : std::vector<std::vector<std::string>>{{},
                                                                   {"run"},
                                                                   {"plan"},
                                                                   {"mesh"},
                                                                   {"mesh", "sphere"},
                                                                   {"mesh", "info"},
                                                                   {"study"},
                                                                   {"study", "maxwell"},
                                                                   {"study", "strain-rate-noise"},
                                                                   {"study", "layers"},
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
  const auto file_of = [&](const std::string& study) { return (directory / (study + ".csv")).string(); };
  const auto study = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "study");
    arguments.insert(arguments.end(), {"--out", file_of(arguments[1])});
    return run_program(arguments);
  };
  ASSERT_EQ(study({"maxwell", "--scheme", "fd", "int1", "--k", "1", "2", "--dt", "6", "5"}).exit_code, 0);
  const auto table = read_file(file_of("maxwell"));
  EXPECT_THAT(table, AllOf(HasSubstr("scheme,viscosity,stiffness"), HasSubstr("\nint1,100,2,600,5,")));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 8);
  ASSERT_EQ(study({"strain-rate-noise", "--interval", "3"}).exit_code, 0);
  EXPECT_THAT(read_file(file_of("strain-rate-noise")), HasSubstr("cosine4,100,0,3,"));
  ASSERT_EQ(
      study({"twisting-sphere", "--level", "1", "--period", "8", "--angle", "0", "30", "--kernel", "roma3"})
          .exit_code,
      0);
  EXPECT_THAT(read_file(file_of("twisting-sphere")),
              AllOf(HasSubstr("\nsurface,80,20,0 0 1,30,,int2,0.75,theta-phi,"),
                    HasSubstr("\nflow,80,20,0 0 1,0,roma3,fd,0.25,phi-phi,")));
  ASSERT_EQ(study({"layers", "--flow", "couette", "--form", "harmonic", "sharp", "--lambda", "5", "2",
                   "--height", "8", "--kernel", "roma3"})
                .exit_code,
            0);
  EXPECT_THAT(read_file(file_of("layers")), AllOf(HasSubstr("\ncouette,harmonic,roma3,0.1875,5,8,"),
                                                  HasSubstr("\ncouette,sharp,roma3,0.1875,2,8,")));
  for (const auto& wrong : std::vector<std::vector<std::string>>{{"maxwell", "--scheme", "rk4"},
                                                                 {"maxwell", "--k", "-1"},
                                                                 {"strain-rate-noise", "--interval", "0"},
                                                                 {"layers", "--flow", "pipe"},
                                                                 {"layers", "--sheet", "0.05"},
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
