// What a resumed run, and one that replaces another, refuses: with nothing written by then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/integration/resume_fixture.hpp"

namespace {

using namespace tanktread::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Ways to bring a run to a state in which it must not go on, and words of the refusal.
struct Refusal {
  std::string name;
  std::function<void(const fs::path&)> break_it;
  std::vector<std::string> options;
  std::vector<std::string> words;
};

/// A change of one key in echo.toml, and how the refusal says it.
Refusal changed_key(const std::string& name, const std::string& from, const std::string& to,
                    const std::string& says) {
  return {name,
          [=](const fs::path& run) { replace_in(run / "echo.toml", from, to); },
          {},
          {says, "set back each of these", "--output NEW"}};
}

std::vector<Refusal> refusals() {
  const auto nothing = [](const fs::path&) {};
  const std::string last = "checkpoints/step_0000000180", before = "checkpoints/step_0000000120";
  std::vector<Refusal> all = {
      changed_key("wall speed", "wall_speed = 0.02", "wall_speed = 0.01",
                  "flow.wall_speed: 0.02 in the checkpoint, 0.01 in echo.toml"),
      changed_key("tau", "relaxation_time = 1.0", "relaxation_time = 0.8", "flow.relaxation_time: 1.0 in"),
      changed_key("Ca", "capillary_number = 0.3", "capillary_number = 0.2", "membrane.capillary_number: 0.3"),
      changed_key("radius", "radius = 5.0", "radius = 4.0", "capsule.0.radius: 5.0"),
      changed_key("level", "level = 2", "level = 1", "capsule.0.mesh.level: 2"),
      changed_key("kernel", "\"stockie6\"", "\"roma3\"", "coupler.kernel: \"stockie6\""),
      changed_key("correction", "tangential_correction = true", "tangential_correction = false",
                  "coupler.tangential_correction: true"),
      changed_key("modulus of Ca", "\"E_s\"", "\"G_s\"", "membrane.capillary_modulus: \"E_s\""),
      {"a capsule more",
       [](const fs::path& run) {
         std::ofstream(run / "echo.toml", std::ios::app)
             << "\n[[capsule]]\nradius = 2.0\nposition = [2.0, 2.0, 12.0]\n";
       },
       {},
       {"[[capsule]]: 1 in the checkpoint, 2 in echo.toml"}},
      {"no echo", [](const fs::path& run) { fs::remove(run / "echo.toml"); }, {}, {"echo.toml"}},
      {"half an echo",
       [](const fs::path& run) {
         write_file(run / "echo.toml", read_file(run / "echo.toml").substr(0, 300));
       },
       {},
       {"echo.toml"}},
      {"no checkpoints",
       [](const fs::path& run) { fs::remove_all(run / "checkpoints"); },
       {},
       {"no checkpoint"}},
      {"damaged fluid",
       [=](const fs::path& run) { keep_half(run / last / "fluid.vti"); },
       {},
       {"fluid.vti", "cannot be used", "--from-step 120"}},
      {"no membrane",
       [=](const fs::path& run) { fs::remove(run / last / "membrane.vtu"); },
       {},
       {"membrane.vtu", "--from-step 120"}},
      {"damaged case of the checkpoint",
       [=](const fs::path& run) { write_file(run / last / "echo.toml", "[flow"); },
       {},
       {"step_0000000180/echo.toml", "--from-step 120"}},
      {"damaged counts",
       [=](const fs::path& run) { write_file(run / last / "output.toml", "rows = -1"); },
       {},
       {"output.toml", "rows", "--from-step 120"}},
      {"damaged fluid and four rows",  // fewer than those up to step 120
       [=](const fs::path& run) {
         keep_half(run / last / "fluid.vti");
         keep_lines(run / "observables.csv", 1 + 4);
       },
       {},
       {"cannot be used", "--from-step 120 --accept-gaps"}},
      {"all damaged",
       [=](const fs::path& run) {
         for (const auto& step : {last, before}) keep_half(run / step / "fluid.vti");
       },
       {},
       {"no other that can be used", "echo.toml --output NEW"}},
      {"no table",
       [](const fs::path& run) { fs::remove(run / "observables.csv"); },
       {},
       {"observables.csv: is missing", "--accept-gaps"}},
      {"four rows of seven",  // 0, 0.05, ... 0.3; those up to step 120 are five
       [](const fs::path& run) { keep_lines(run / "observables.csv", 1 + 4); },
       {},
       {"holds 4 of 7 rows of those up to step 180, the last of step 90", "--accept-gaps"}},
      {"five rows of seven",
       [](const fs::path& run) { keep_lines(run / "observables.csv", 1 + 5); },
       {},
       {"holds 5 of 7 rows", "--from-step 120"}},
      {"a row less in the middle",
       [](const fs::path& run) {
         auto text = read_file(run / "observables.csv");
         const auto row = text.find("\n60,");
         write_file(run / "observables.csv", text.erase(row, text.find('\n', row + 1) - row));
       },
       {},
       {"holds 6 of 7 rows"}},
      {"Windows line ends",
       [](const fs::path& run) { to_windows_line_ends(run / "observables.csv"); },
       {},
       {"Windows line ends", "sed -i"}},
      {"another header",
       [](const fs::path& run) { replace_in(run / "observables.csv", "deformation", "Deformation"); },
       {},
       {"another header"}},
      {"a line that is no row",
       [](const fs::path& run) { replace_in(run / "observables.csv", "\n60,", "\nsixty,"); },
       {},
       {"line 4 is no row"}},
      {"an entry of another run",
       [](const fs::path& run) { replace_in(run / "membrane.pvd", "membrane_0000000000.vtu", "mine.vtu"); },
       {},
       {"mine.vtu is not of this run"}},
      {"a file where the folder should be",
       [](const fs::path& run) {
         fs::remove_all(run / "membrane");
         write_file(run / "membrane", "a file");
       },
       {},
       {"membrane: is no folder"}},
      {"an end that is past", nothing, {"--shear-time", "0.1"}, {"--shear-time 0.1", "step 180"}},
      {"an end in the echo that is past",
       [](const fs::path& run) { replace_in(run / "echo.toml", "shear_time = 0.3", "shear_time = 0.2"); },
       {},
       {"run.shear_time = 0.2", "step 180"}},
      {"a step without a checkpoint", nothing, {"--from-step", "7"}, {"--from-step 7", "steps 120, 180"}},
      {"a record in the run's own place", nothing, {"--record", "OUT/packets/record"}, {"--record"}},
      {"a record that is the run", nothing, {"--record", "OUT"}, {"--record"}},
      {"a record below a file", nothing, {"--record", "OUT/echo.toml/record"}, {"--record"}},
      {"a record of steps that are past", nothing, {"--record", "NEW", "--from", "10"}, {"--from 10"}},
  };
  return all;
}

TEST_F(Resume, WhatIsRefusedHasWrittenNothing) {
  run_half();
  for (const auto& refusal : refusals()) {
    const auto run = copy_of_half("out");
    refusal.break_it(run);
    auto options = refusal.options;
    for (auto& option : options) {
      if (option.starts_with("OUT")) option = run.string() + option.substr(3);
      if (option == "NEW") option = (directory_ / "record").string();
    }
    const bool has_end = std::ranges::find(options, "--shear-time") != options.end() ||
                         refusal.name == "an end in the echo that is past";
    if (!has_end) options.insert(options.end(), {"--shear-time", "0.4"});
    const auto before = contents_of(run);
    const auto ended = resume(run, options);
    EXPECT_EQ(ended.exit_code, 2) << refusal.name << ": " << ended.output;
    for (const auto& words : refusal.words) EXPECT_THAT(ended.output, HasSubstr(words)) << refusal.name;
    EXPECT_TRUE(contents_of(run) == before) << refusal.name << " has changed the directory";
    EXPECT_FALSE(fs::exists(directory_ / "record")) << refusal.name;
  }
}

TEST_F(Resume, AnEarlierRunStaysUntilAllIsChecked) {
  run_half();
  const auto run = copy_of_half("out");
  write_file(directory_ / "file", "");
  const std::vector<std::vector<std::string>> refused = {
      {"--set", "flow.wall_speed=-1"},
      {"--set", "capsule.0.mesh={file=\"nowhere.vtu\"}"},
      {"--set", "membrane.command=[\"no-such-program\"]"},
      {"--set", "capsule.0.mesh={file=\"" + (run / "membrane/membrane_0000000150.vtu").string() + "\"}"},
      {"--record", (directory_ / "file").string()},
      {"--record", (directory_ / "file/record").string()},
      {"--record", run.string()},
      {"--record", (run / "membrane/record").string()},
      {"--record", (directory_ / "record").string(), "--from", "7", "--to", "3"}};
  const auto before = contents_of(run);
  for (auto options : refused) {
    options.push_back("--force");
    const auto ended = run_program(run_to("out", options));
    EXPECT_EQ(ended.exit_code, 2) << ::testing::PrintToString(options) << ended.output;
    EXPECT_TRUE(contents_of(run) == before) << ::testing::PrintToString(options);
  }
}

}  // namespace
