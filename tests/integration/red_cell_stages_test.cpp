// A red cell that starts in another shape than the one without stress, by both kinds of membrane viscosity:
// its stages, records and resumes are the run bit for bit.
#include <array>
#include <fstream>

#include "exchange/vtk_files.hpp"
#include "membrane/mesh.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Beside it a sphere of before, elastic. 400 steps a shear time: 12 steps.
constexpr const char* red_cell_case = R"([flow]
box = [30, 16, 20]
wall_speed = 0.025
start = "developed"
[[capsule]]
radius = 3.0
position = [8.0, 8.0, 10.0]
viscosity_ratio = 2.0
mesh = { shape = "biconcave", level = 2, direction = [1.0, 0.0, 2.0] }
stress_free = { shape = "spheroid", reduced_volume = 0.95 }
[[capsule]]
radius = 3.0
position = [22.0, 8.0, 10.5]
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
[coupler]
keep_volume = true
[run]
shear_time = 0.03
checkpoint_every = 0.0125
[output]
observables_every = 0.0025
measures_every = 0.0025
energy_every = 0.0025
membrane_every = 0.005
)";
constexpr int n_steps = 12;

/// @param GetParam() the table `viscous` of the red cell's membrane
class RedCell : public Stages, public ::testing::WithParamInterface<std::pair<const char*, const char*>> {
 protected:
  void SetUp() override {
    const std::string viscous = std::string("membrane = { viscous = { ") + GetParam().second + " } }\n";
    std::string text = red_cell_case;
    text.insert(text.find("[[capsule]]\nradius = 3.0\nposition = [22"), viscous);
    std::ofstream(path("case.toml")) << text;
  }
  bool is_implicit() const { return GetParam().first == std::string("Implicit"); }
  std::vector<std::string> components() const {
    if (is_implicit()) return {"membrane", "implicit", "coupler", "fluid"};
    return {"membrane", "coupler", "fluid"};
  }
  void expect_same_runs(const std::string& first, const std::string& second) const {
    const auto a = result_files(path(first)), b = result_files(path(second));
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].first, b[k].first);
      EXPECT_TRUE(a[k].second == b[k].second) << a[k].first << " differs";
    }
    for (const char* file : {"fluid.vti", "membrane.vtu"}) {
      const auto place = std::string("/checkpoints/step_0000000012/") + file;
      EXPECT_TRUE(read_file(path(first + place)) == read_file(path(second + place))) << file;
    }
  }
  std::vector<double> array(const std::string& file, const char* name) const {
    return exchange::find_array(exchange::read_surface(path(file)).point_data, name, file).values;
  }
};
INSTANTIATE_TEST_SUITE_P(
    Stages, RedCell,
    ::testing::Values(
        std::pair("Fd",
                  "scheme = \"fd\", boussinesq_shear = 1.0, boussinesq_dilatational = 2.0, "
                  "spring_stiffness = 30.0, interval = 3, strain_sampling = \"moving-average\""),
        std::pair("EveryStep", "scheme = \"int2\", boussinesq_shear = 1.0, spring_stiffness = 30.0"),
        std::pair("Implicit",
                  "scheme = \"implicit\", boussinesq_shear = 5.0, "
                  "boussinesq_dilatational = 2.0, spring_stiffness = 200.0")),
    [](const auto& tested) { return std::string(tested.param.first); });

TEST_P(RedCell, StagedEqualsFused) {
  constexpr int n_staged = 4;  // an update of every third step, and the step after it
  call({"run", path("case.toml"), "--output", path("out"), "--record", path("record"), "--to",
        std::to_string(n_staged)});
  stage({"membrane", "--out", path("membrane.vtu")});
  stage({"coupler", "mark", "--in", path("membrane.vtu"), "--out", path("inside.vti")});
  stage({"fluid", "--steps", "0", "--inside", path("inside.vti"), "--out", path("fluid.vti"), "--fields",
         path("flow.vti"), "--free", path("free.vti")});
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/begin/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/begin/fluid.vti")));
  for (int step = 0; step < n_staged; ++step) {
    stage({"coupler", "interpolate", "--in", path("membrane.vtu"), "--grid", path("flow.vti"), "--out",
           path("velocity.vtu")});
    const auto explicit_forces = path(is_implicit() ? "explicit.vtu" : "membrane.vtu");
    stage({"membrane", "--in", path("velocity.vtu"), "--move", "--state", path("membrane.vtu"), "--out",
           explicit_forces});
    if (is_implicit())
      stage({"implicit", "--in", explicit_forces, "--grid", path("free.vti"), "--out", path("membrane.vtu")});
    stage({"coupler", "spread", "--in", path("membrane.vtu"), "--out", path("force.vti")});
    stage({"coupler", "mark", "--in", path("membrane.vtu"), "--out", path("inside.vti")});
    stage({"fluid", "--state", path("fluid.vti"), "--force", path("force.vti"), "--inside",
           path("inside.vti"), "--out", path("fluid.vti"), "--fields", path("flow.vti"), "--free",
           path("free.vti")});
  }
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/end/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/end/fluid.vti")));
}

TEST_P(RedCell, ThroughFilesEqualsInMemory) {
  call({"run", path("case.toml"), "--output", path("memory")});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  std::filesystem::remove_all(path("files/packets"));
  expect_same_runs("memory", "files");
}

TEST_P(RedCell, IsReplayedComponentByComponent) {
  for (const int from : {0, 4}) {
    std::filesystem::remove_all(path("out"));
    std::filesystem::remove_all(path("record"));
    record(from);
    for (const auto& component : components()) {
      EXPECT_THAT(call({"replay", path("record"), "--only", component}),
                  HasSubstr("identical: " + std::to_string(n_steps - from) + " steps"))
          << component;
    }
  }
}

TEST_P(RedCell, GoesOnBitForBitFromACheckpoint) {
  call({"run", path("case.toml"), "--output", path("whole")});
  // 0: that of the start, before any step. 5: within an interval of three steps.
  for (const std::string step : {"0", "5"}) {
    std::filesystem::remove_all(path("half"));
    call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.0125"});
    call({"run", "--resume", path("half"), "--shear-time", "0.03", "--from-step", step});
    expect_same_runs("whole", "half");
  }
}

TEST_P(RedCell, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const std::string threads : {"1", "3"})
    call({"run", path("case.toml"), "--output", path(threads), "--threads", threads});
  EXPECT_TRUE(read_file(path("1/checkpoints/step_0000000012/membrane.vtu")) ==
              read_file(path("3/checkpoints/step_0000000012/membrane.vtu")));
}

TEST_P(RedCell, AStateHoldsBothShapesAndTheRatiosAreOfTheFirst) {
  call({"run", path("case.toml"), "--output", path("out")});
  const std::string end = "out/checkpoints/step_0000000012/membrane.vtu";
  const auto start = exchange::read_surface(path("out/membrane/membrane_0000000000.vtu")).points;
  EXPECT_EQ(array(end, "start_position"), start);
  EXPECT_NE(array(end, "reference_position"), start);
  const auto table = read_file(path("out/observables.csv"));
  const auto row = table.substr(table.find("\n0,0,"), 200);
  EXPECT_THAT(row, HasSubstr(",1,1,")) << "volume and area ratio of the red cell at the start";
}

TEST_P(RedCell, AMotionGoesOnFromWhereTheCaseStarts) {
  call({"run", path("case.toml"), "--output", path("out")});
  stage({"membrane", "--motion", path("out/membrane.pvd"), "--out", path("motion")});
  // The viscous stress of the first step is that of a step's motion, not of the whole way from the shape
  // without stress: it is as that of the run, to what linear interpolation between files makes of it.
  EXPECT_TRUE(std::filesystem::exists(path("motion/membrane/membrane_0000000012.vtu")));
  if (is_implicit()) return;
  stage({"membrane", "--motion", path("out/membrane.pvd"), "--out", path("other"), "--set",
         "capsule.0.mesh.direction=[1, 0, 1]"});  // a turn is no strain
  EXPECT_THAT(stage({"membrane", "--motion", path("out/membrane.pvd"), "--out", path("refused"), "--set",
                     "capsule.0.mesh.shape=sphere"},
                    2),
              HasSubstr("must begin with the shape that the case starts with"));
}

TEST_P(RedCell, AStateOfAnotherStartIsRefused) {
  call({"run", path("case.toml"), "--output", path("out")});
  const auto state = path("out/checkpoints/step_0000000012/membrane.vtu");
  const auto refused = [&](const std::string& assignment) {
    return stage({"membrane", "--in", state, "--out", path("new.vtu"), "--set", assignment}, 2);
  };
  EXPECT_THAT(refused("capsule.0.stress_free.reduced_volume=0.9"),
              AllOf(HasSubstr("the stress-free shape of capsule 0 lies up to"), HasSubstr("stress_free")));
  EXPECT_THAT(refused("capsule.0.mesh.direction=[1, 0, 1]"), HasSubstr("shape of capsule 0 lies up to"));
  stage({"membrane", "--in", state, "--out", path("new.vtu")});
}

TEST_P(RedCell, ACaseThatWasChangedIsNamedWhenTheRunGoesOn) {
  call({"run", path("case.toml"), "--output", path("out"), "--shear-time", "0.025"});
  const auto echo = path("out/echo.toml");
  const auto text = read_file(echo);
  const std::array<std::pair<std::string, std::string>, 2> changes = {
      {{"stress_free.reduced_volume = 0.95", "stress_free.reduced_volume = 0.9"},
       {"mesh.direction = [1.0, 0.0, 2.0]", "mesh.direction = [1.0, 0.0, 3.0]"}}};
  for (const auto& [what, with] : changes) {
    auto other = text;
    ASSERT_NE(other.find(what), std::string::npos) << what << "\n" << text;
    std::ofstream(echo) << other.replace(other.find(what), what.size(), with);
    EXPECT_THAT(call({"run", "--resume", path("out"), "--shear-time", "0.03"}, 2),
                HasSubstr("capsule.0." + what.substr(0, what.find(' '))));
  }
  std::ofstream(echo) << text;
  call({"run", "--resume", path("out"), "--shear-time", "0.03"});
}

class RedCellFiles : public Stages {};

TEST_F(RedCellFiles, TheProgramWritesItsShapes) {
  const auto info = [&](const std::string& name) { return call({"mesh", "info", path(name)}); };
  call({"mesh", "biconcave", "--level", "3", "--radius", "2", path("biconcave.vtu")});
  EXPECT_THAT(info("biconcave.vtu"),
              AllOf(HasSubstr("triangles           1280"), HasSubstr("can be made of it")));
  call({"mesh", "spheroid", "--level", "2", "--aspect-ratio", "0.5", "--centre", "1", "2", "3",
        path("flat.vtu")});
  EXPECT_THAT(info("flat.vtu"), HasSubstr("centre              1, 2, 3"));
  call({"mesh", "spheroid", "--level", "2", "--reduced-volume", "0.95", path("round.vtu")});
  EXPECT_THAT(info("round.vtu"), HasSubstr("can be made of it"));
  EXPECT_THAT(call({"mesh", "spheroid", path("none.vtu")}, 2),
              HasSubstr("give --aspect-ratio or --reduced-volume"));
  EXPECT_THAT(
      call({"mesh", "spheroid", "--aspect-ratio", "2", "--reduced-volume", "0.9", path("none.vtu")}, 2),
      HasSubstr("--aspect-ratio"));
  EXPECT_THAT(call({"mesh", "spheroid", "--aspect-ratio", "20", path("none.vtu")}, 2), HasSubstr("0.1"));
  EXPECT_FALSE(std::filesystem::exists(path("none.vtu")));
}

// A file of a shape is that shape: of the volume of the radius to the last triangle, where the shape of a
// case has its nodes on the surface.
TEST_F(RedCellFiles, AStressFreeFileIsReadOnceAndNamedInTheEcho) {
  call({"mesh", "biconcave", "--level", "2", path("cell.vtu")});
  call({"mesh", "spheroid", "--level", "2", "--reduced-volume", "0.95", path("round.vtu")});
  const std::vector<std::string> files = {"--set", "capsule.0.mesh={file = \"cell.vtu\"}", "--set",
                                          "capsule.0.stress_free.file=round.vtu"};
  std::vector<std::string> arguments = {"run",       path("case.toml"), "--output",
                                        path("out"), "--shear-time",    "0.02"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  EXPECT_THAT(call(arguments), AllOf(HasSubstr("stress-free shape"), HasSubstr("round.vtu")));
  EXPECT_THAT(read_file(path("out/echo.toml")), HasSubstr("stress_free.file_hash = \""));
  // It is in the checkpoint: a run that goes on does not ask for it.
  std::filesystem::remove(path("cell.vtu"));
  std::filesystem::remove(path("round.vtu"));
  call({"run", "--resume", path("out"), "--shear-time", "0.04"});
  EXPECT_THAT(call({"run", path("out/echo.toml"), "--output", path("again")}, 2),
              HasSubstr("capsule.0.stress_free.file"));
}

TEST_F(RedCellFiles, ForceRemovesNoFileThatTheCaseNames) {
  call({"run", path("case.toml"), "--output", path("out"), "--shear-time", "0.004"});
  call({"mesh", "spheroid", "--level", "2", "--reduced-volume", "0.95", path("round.vtu")});
  std::filesystem::rename(path("round.vtu"), path("out/membrane/round.vtu"));
  EXPECT_THAT(call({"run", path("case.toml"), "--output", path("out"), "--force", "--set",
                    "capsule.0.stress_free.file=out/membrane/round.vtu"},
                   2),
              HasSubstr("--force would remove capsule.0.stress_free.file"));
  EXPECT_TRUE(std::filesystem::exists(path("out/membrane/round.vtu")));
}

}  // namespace
}  // namespace tanktread::testing
