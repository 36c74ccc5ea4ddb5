// Steps recorded, and a component at work again on them.
#include <cmath>
#include <csignal>

#include "exchange/vtk_files.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Replay : public Stages {};

class ReplayedRun : public CorrectedOrNot {};
INSTANTIATE_TEST_SUITE_P(Replay, ReplayedRun, ::testing::Bool(), name_of_correction);

TEST_P(ReplayedRun, GivesWhatItGaveComponentByComponent) {
  record(5);  // within an interval of the viscous capsule
  for (const char* component : {"membrane", "coupler", "fluid"}) {
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 15 steps"))
        << component;
  }
}

TEST_F(Replay, ACorrectionFromAForceThatIsNotFiniteIsRefused) {
  correct();
  record(5);
  const auto file = path("record/node_force/node_force_0000000008.vtu");
  auto surface = exchange::read_surface(file);
  surface.point_data[0].values[3 * 5] = std::nan("");
  exchange::write_surface(file, surface);
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}, 2),
              HasSubstr("the force of node 5 of surface 0 is not finite"));
}

TEST_F(Replay, TheRecordOfAResumedRunIsTheSame) {
  record(10);
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.02"});
  call({"run", "--resume", path("half"), "--shear-time", "0.04", "--record", path("again"), "--from", "10"});
  EXPECT_THAT(call({"diff", path("record"), path("again")}), HasSubstr("identical"));
}

TEST_F(Replay, TheFirstDifferentBitIsNamed) {
  record(5);
  // The last bit of one number of each component's output, recorded wrongly, with a hash that fits.
  const auto nudge = [](double& value) { value = std::nextafter(value, 1.0); };
  const auto force = path("record/node_force/node_force_0000000009.vtu");
  auto surface = exchange::read_surface(force);
  nudge(surface.point_data[0].values[3 * 20 + 1]);
  exchange::write_surface(force, surface);
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane"}, 1),
              AllOf(HasSubstr("different: step 9, packet node_force, array total_force"),
                    HasSubstr("index 61 (tuple 20, component 1)"), HasSubstr("recorded "),
                    HasSubstr("node_force_0000000009.vtu")));

  const auto end = path("record/end/fluid.vti");
  auto grid = exchange::read_grid(end);
  nudge(grid.point_data[0].values[7]);
  exchange::write_grid(end, grid);
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid"}, 1),
              HasSubstr("different: step 20, packet end, array populations (point data), index 7"));

  const auto velocity = path("record/node_velocity/node_velocity_0000000012.vtu");
  surface = exchange::read_surface(velocity);
  nudge(surface.point_data[0].values[0]);
  exchange::write_surface(velocity, surface);
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}, 1),
              HasSubstr("different: step 9, packet grid_force"))
      << "the force that was recorded wrongly spreads otherwise, before the velocity is reached";
}

TEST_F(Replay, AnotherSettingGivesTheSizeOfTheDifference) {
  record(5);
  const auto output = call({"replay", path("record"), "--only", "membrane", "--set",
                            "membrane.elastic_law=neo-hookean", "--out", path("difference")});
  EXPECT_THAT(output, AllOf(HasSubstr("15 steps"), HasSubstr("node_force total_force"), HasSubstr("max "),
                            HasSubstr("rms ")));
  const auto file = exchange::read_surface(path("difference/node_force/node_force_0000000020.vtu"));
  const auto& recorded = exchange::find_array(file.point_data, "total_force", "file").values;
  const auto& replayed = exchange::find_array(file.point_data, "replayed_total_force", "file").values;
  const auto& difference = exchange::find_array(file.point_data, "difference_total_force", "file").values;
  double largest = 0;
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    EXPECT_EQ(difference[k], replayed[k] - recorded[k]);
    largest = std::max(largest, std::abs(difference[k]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_EQ(exchange::read_series(path("difference/node_force.pvd")).size(), 15u);
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler", "--set", "coupler.kernel=peskin4"}),
              HasSubstr("node_velocity velocity"));
  EXPECT_THAT(
      call({"replay", path("record"), "--only", "coupler", "--set", "coupler.tangential_correction=true"}),
      HasSubstr("node_velocity velocity"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid", "--set", "flow.inertia=false"}),
              HasSubstr("end populations"));
}

TEST_F(Replay, RefusesWhatIsNoRecord) {
  record(5);
  EXPECT_THAT(call({"replay", path("out"), "--only", "fluid"}, 2),
              HasSubstr("holds no begin: not a complete record"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "driver"}, 2), HasSubstr("--only"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid", "--set", "flow.box=[26,18,22]"}, 2),
              HasSubstr("populations"));
  std::filesystem::remove(path("record/grid_force/grid_force_0000000011.vti"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid"}, 2),
              HasSubstr("grid_force_0000000011.vti: no such file"));
}

TEST_F(Replay, ARecordWithoutAnEndIsReplayedUpToItsLastWholeStep) {
  record(5);
  std::filesystem::remove_all(path("record/end"));
  std::filesystem::remove(path("record/grid_force/grid_force_0000000020.vti"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane"}), HasSubstr("identical: 14 steps"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "fluid"}), HasSubstr("identical: 14 steps"));
}

TEST_F(Replay, ARunStoppedByASignalLeavesAWholeRecord) {
  const auto some = directory_.path() / "record/grid_force/grid_force_0000000004.vti";
  const auto ended = run_and_signal(
      {"run", path("case.toml"), "--output", path("out"), "--shear-time", "20", "--record", path("record")},
      SIGINT, [&] { return std::filesystem::exists(some); });
  EXPECT_EQ(ended.exit_code, 130) << ended.output;
  EXPECT_TRUE(std::filesystem::exists(path("record/end/membrane.vtu")));
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane"}), HasSubstr("identical"));
}

TEST_F(Replay, AResumedRunRecordsFromWhereItBegins) {
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.02"});
  EXPECT_THAT(call({"run", "--resume", path("half"), "--record", path("none")}, 2),
              HasSubstr("the run is at its end"));
  EXPECT_FALSE(std::filesystem::exists(path("none")));
  call({"run", "--resume", path("half"), "--shear-time", "0.03", "--record", path("record")});
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}), HasSubstr("identical: 5 steps"));
}

TEST_F(Replay, AnImpossibleRecordLeavesTheEarlierRun) {
  call({"run", path("case.toml"), "--output", path("out")});
  std::ofstream(path("file")) << "";
  for (const auto* record : {"file", "file/below"}) {
    call({"run", path("case.toml"), "--output", path("out"), "--force", "--record", path(record)}, 2);
    EXPECT_TRUE(std::filesystem::exists(path("out/checkpoints/step_0000000020/fluid.vti"))) << record;
  }
}

TEST_F(Replay, TheCaseBesideARecordIsTheOneThatWasRecorded) {
  record(10);
  const auto echo = path("record/echo.toml");
  auto text = read_file(echo);
  const std::string speed = "wall_speed = 0.02";
  std::ofstream(echo) << text.replace(text.find(speed), speed.size(), "wall_speed = 0.01");
  const auto refused = call({"replay", path("record"), "--only", "fluid"}, 2);
  EXPECT_THAT(refused, AllOf(HasSubstr("flow.wall_speed: 0.02 in begin/echo.toml, 0.01 in echo.toml"),
                             HasSubstr("--set")));
  // The way that it names.
  std::filesystem::copy_file(path("record/begin/echo.toml"), echo,
                             std::filesystem::copy_options::overwrite_existing);
  call({"replay", path("record"), "--only", "fluid", "--set", "flow.wall_speed=0.01"});
}

TEST_F(Replay, OnlyStepsOfTheRunCanBeRecorded) {
  const auto refusal = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"run", path("case.toml"), "--output", path("out"), "--record", path("record")});
    const auto output = call(more, 2);
    EXPECT_FALSE(std::filesystem::exists(path("out")));
    return output;
  };
  EXPECT_THAT(refusal({"--from", "5", "--to", "5"}),
              HasSubstr("--from 5 --to 5: the run goes from step 0 to step 20"));
  EXPECT_THAT(refusal({"--to", "21"}), HasSubstr("--to 21"));
  EXPECT_THAT(refusal({"--through-files"}), HasSubstr("--record"));
  std::filesystem::create_directories(path("record"));
  std::ofstream(path("record/mine.txt")) << "keep";
  EXPECT_THAT(refusal({}), HasSubstr("holds something already"));
}

}  // namespace
}  // namespace tanktread::testing
