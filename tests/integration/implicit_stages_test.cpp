// The stages, records and resumes of a run with an implicit viscosity: bit for bit the run.
#include <cmath>
#include <sstream>

#include "exchange/vtk_files.hpp"
#include "tests/integration/implicit_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ImplicitRun : public Implicit, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    Implicit::SetUp();
    if (GetParam()) correct();
  }
};
INSTANTIATE_TEST_SUITE_P(Stages, ImplicitRun, ::testing::Bool(), name_of_correction);

TEST_P(ImplicitRun, StagedEqualsFused) {
  record();
  stage({"membrane", "--out", path("membrane.vtu")});
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--fields", path("flow.vti"), "--free",
         path("free.vti")});
  for (int step = 0; step < 12; ++step) {
    stage({"coupler", "interpolate", "--in", path("membrane.vtu"), "--grid", path("flow.vti"), "--out",
           path("velocity.vtu")});
    stage({"membrane", "--in", path("velocity.vtu"), "--move", "--state", path("membrane.vtu"), "--out",
           path("elastic.vtu")});
    stage(
        {"implicit", "--in", path("elastic.vtu"), "--grid", path("free.vti"), "--out", path("membrane.vtu")});
    stage({"coupler", "spread", "--in", path("membrane.vtu"), "--out", path("force.vti")});
    stage({"fluid", "--state", path("fluid.vti"), "--force", path("force.vti"), "--out", path("fluid.vti"),
           "--fields", path("flow.vti"), "--free", path("free.vti")});
  }
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/end/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/end/fluid.vti")));
  EXPECT_THAT(call({"diff", path("membrane.vtu"), path("record/end/membrane.vtu")}), HasSubstr("identical"));
}

TEST_P(ImplicitRun, ThroughFilesEqualsInMemory) {
  call({"run", path("case.toml"), "--output", path("memory")});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  for (const char* packet : {"grid_velocity.vti", "node_velocity.vtu", "positions.vtu", "explicit_force.vtu",
                             "free_velocity.vti", "node_force.vtu", "grid_force.vti"}) {
    EXPECT_TRUE(std::filesystem::exists(directory_ / "files" / "packets" / packet)) << packet;
  }
  std::filesystem::remove_all(directory_ / "files" / "packets");
  EXPECT_EQ(result_files(directory_ / "memory"), result_files(directory_ / "files"));
  for (const char* file : {"fluid.vti", "membrane.vtu"}) {
    const auto place = std::filesystem::path("checkpoints/step_0000000012") / file;
    EXPECT_TRUE(read_file(directory_ / "memory" / place) == read_file(directory_ / "files" / place)) << file;
  }
}

TEST_P(ImplicitRun, IsReplayedComponentByComponent) {
  record(3);
  for (const char* component : {"membrane", "implicit", "coupler", "fluid"}) {
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 9 steps"))
        << component;
  }
}

TEST_P(ImplicitRun, GoesOnBitForBitFromACheckpointInTheMiddle) {
  call({"run", path("case.toml"), "--output", path("whole")});
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.02"});
  for (const std::string step : {"5", "10"}) {
    call({"run", "--resume", path("half"), "--shear-time", "0.024", "--from-step", step});
    const auto whole = result_files(directory_ / "whole"), half = result_files(directory_ / "half");
    ASSERT_EQ(whole.size(), half.size());
    for (std::size_t k = 0; k < whole.size(); ++k) {
      EXPECT_EQ(whole[k].first, half[k].first);
      EXPECT_TRUE(whole[k].second == half[k].second) << whole[k].first << " after " << step;
    }
    for (const char* file : {"fluid.vti", "membrane.vtu"}) {
      const auto place = std::filesystem::path("checkpoints/step_0000000012") / file;
      EXPECT_TRUE(read_file(directory_ / "whole" / place) == read_file(directory_ / "half" / place)) << file;
    }
  }
}

TEST_F(Implicit, OneBitOfAPacketIsFound) {
  record(3);
  const auto force = path("record/explicit_force/explicit_force_0000000007.vtu");
  auto surface = exchange::read_surface(force);
  // Of the elastic capsule, whose numbers are handed on: in a sum with a viscous force a last bit may be
  // lost.
  auto& number = surface.point_data[0].values[3 * 42 + 61];
  number = std::nextafter(number, 1.0);
  exchange::write_surface(force, surface);
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane"}, 1),
              HasSubstr("different: step 7, packet explicit_force, array total_force"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "implicit"}, 1),
              HasSubstr("different: step 7, packet node_force, array total_force"));
  const auto free = path("record/free_velocity/free_velocity_0000000009.vti");
  auto grid = exchange::read_grid(free);
  for (auto& array : grid.point_data) {
    if (array.name == "mobility") array.values[1000] = std::nextafter(array.values[1000], 1.0);
  }
  exchange::write_grid(free, grid);
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid"}, 1),
              HasSubstr("different: step 9, packet free_velocity, array mobility"));
}

TEST_F(Implicit, TheStateAtTheEndIsComparedByImplicit) {
  record(3);
  const auto end = path("record/end/membrane.vtu");
  auto surface = exchange::read_surface(end);
  for (auto& array : surface.field_data) {
    if (array.name == "history_0") array.values[5] = std::nextafter(array.values[5], 1.0);
  }
  exchange::write_surface(end, surface);
  EXPECT_THAT(call({"replay", path("record"), "--only", "implicit"}, 1),
              AllOf(HasSubstr("packet end"), HasSubstr("history_0")));
}

TEST_F(Implicit, AnotherToleranceGivesTheSizeOfTheDifference) {
  record(3);
  EXPECT_THAT(
      call({"replay", path("record"), "--only", "implicit", "--set", "coupler.implicit_tolerance=1e-9"}),
      AllOf(HasSubstr("9 steps"), HasSubstr("node_force total_force"), HasSubstr("max ")));
  EXPECT_THAT(call({"replay", path("record"), "--only", "implicit", "--set", "coupler.implicit_iterations=1",
                    "--set", "coupler.implicit_tolerance=1e-9"},
                   3),
              HasSubstr("were not found: after 1 iterations"));
}

TEST_F(Implicit, OnlyRunsWithItHaveItsPacketsAndItsColumn) {
  call({"run", path("case.toml"), "--output", path("out"), "--record", path("record")});
  EXPECT_TRUE(std::filesystem::exists(path("record/free_velocity.pvd")));
  const auto first_line = [&](const std::string& run) {
    std::istringstream text(read_file(path(run + "/observables.csv")));
    std::string line;
    std::getline(text, line);
    return line;
  };
  EXPECT_THAT(first_line("out"), ::testing::EndsWith(",x,y,z,viscous_iterations"));
  // Of all capsules together: the same number in the rows of a step. None before the first step.
  std::istringstream text(read_file(path("out/observables.csv")));
  std::string line;
  std::getline(text, line);
  std::vector<std::string> last;
  while (std::getline(text, line)) last.push_back(line.substr(line.rfind(',') + 1));
  ASSERT_EQ(last.size(), 3 * 13U);
  for (std::size_t k = 0; k < last.size(); ++k) {
    EXPECT_EQ(last[k], last[k - k % 3]) << k;
    EXPECT_EQ(last[k] == "0", k < 3) << k;
  }

  // strain_rates stays, and has no effect.
  const std::vector<std::string> none = {"--set", "capsule.0.membrane.viscous.scheme=none", "--set",
                                         "capsule.2.membrane.viscous.scheme=none"};
  std::vector<std::string> elastic = {"run",           path("case.toml"), "--output",
                                      path("elastic"), "--record",        path("elastic_record")};
  elastic.insert(elastic.end(), none.begin(), none.end());
  call(elastic);
  EXPECT_THAT(first_line("elastic"), ::testing::EndsWith(",x,y,z"));
  for (const char* packet : {"free_velocity", "explicit_force"}) {
    EXPECT_FALSE(std::filesystem::exists(directory_ / "elastic_record" / packet));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "elastic_record" / (std::string(packet) + ".pvd")));
  }
  EXPECT_THAT(call({"replay", path("elastic_record"), "--only", "implicit"}, 2),
              HasSubstr("--only implicit: no capsule has an implicit viscosity"));
}

TEST_F(Implicit, AResumeRefusesATableWithAnotherHeader) {
  call({"run", path("case.toml"), "--output", path("out"), "--shear-time", "0.02"});
  const auto table = path("out/observables.csv");
  const auto text = read_file(table);
  std::istringstream lines(text);
  std::string without;
  for (std::string line; std::getline(lines, line);) without += line.substr(0, line.rfind(',')) + "\n";
  std::ofstream(table) << without;
  EXPECT_THAT(call({"run", "--resume", path("out"), "--shear-time", "0.024"}, 2),
              AllOf(HasSubstr("observables.csv"), HasSubstr("has another header than this program writes")));
  EXPECT_EQ(read_file(table), without);
  std::ofstream(table) << text;
  call({"run", "--resume", path("out"), "--shear-time", "0.024"});
}

TEST_F(Implicit, UnsolvedEquationsAreAFailedRunWithItsLastGoodState) {
  const auto output = call({"run", path("case.toml"), "--output", path("out"), "--set",
                            "coupler.implicit_iterations=1", "--set", "coupler.implicit_tolerance=1e-9"},
                           3);
  EXPECT_THAT(output,
              AllOf(HasSubstr("step 1: the implicit viscous forces were not found: after 1 iterations"),
                    HasSubstr("coupler.implicit_tolerance = 1e-09"),
                    HasSubstr("raise coupler.implicit_iterations"), HasSubstr("last good state")));
  // The run has its start as a checkpoint, and nothing of the step that failed.
  EXPECT_TRUE(std::filesystem::exists(path("out/checkpoints/step_0000000000/membrane.vtu")));
  EXPECT_FALSE(std::filesystem::exists(path("out/membrane/membrane_0000000002.vtu")));
}

}  // namespace
}  // namespace tanktread::testing
