// The stages, records and resumes of a run with loads, of which one ends on the way: bit for bit the run.
#include <Eigen/Core>
#include <string>

#include "exchange/vtk_files.hpp"
#include "tests/integration/implicit_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::HasSubstr;

/// The implicit case: of its 12 steps the load of capsule 0 ends with step 7, that of capsule 2 never.
class LoadedRun : public Implicit, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    std::string text = implicit_staged_case;
    const auto add = [&](const std::string& after, const std::string& load) {
      const auto at = text.find(after);
      ASSERT_NE(at, std::string::npos);
      text.insert(at + after.size(), "\nload = " + load);
    };
    add("position = [5.0, 8.0, 9.0]", "{ force = 0.8, direction = [1, 0.5, 2], patch = 0.1, until = 0.014 }");
    add("position = [22.0, 8.0, 8.8]", "{ force = -0.4, direction = [0, 0, 1] }");
    std::ofstream(path("case.toml")) << text << (GetParam() ? "" : plain_coupler);
  }

  Eigen::Matrix3Xd vectors(const std::string& file, const char* name) const {
    const auto surface = exchange::read_surface(path(file));
    const auto& values = exchange::find_array(surface.point_data, name, file).values;
    return Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(values.size() / 3));
  }
};
INSTANTIATE_TEST_SUITE_P(Stages, LoadedRun, ::testing::Bool(), name_of_correction);

TEST_P(LoadedRun, StagedEqualsFused) {
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
}

TEST_P(LoadedRun, ThroughFilesEqualsInMemory) {
  call({"run", path("case.toml"), "--output", path("memory")});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  std::filesystem::remove_all(directory_ / "files" / "packets");
  EXPECT_EQ(result_files(directory_ / "memory"), result_files(directory_ / "files"));
}

TEST_P(LoadedRun, IsReplayedComponentByComponent) {
  record(3);
  for (const char* component : {"membrane", "implicit", "coupler", "fluid"}) {
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 9 steps"))
        << component;
  }
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane", "--set", "capsule.0.load.until=0.012"}),
              HasSubstr("explicit_force total_force"));
}

TEST_P(LoadedRun, GoesOnBitForBitFromBeforeAndAfterItsEnd) {
  call({"run", path("case.toml"), "--output", path("whole")});
  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.02"});
  for (const std::string step : {"5", "10"}) {
    call({"run", "--resume", path("half"), "--shear-time", "0.024", "--from-step", step});
    EXPECT_EQ(result_files(directory_ / "whole"), result_files(directory_ / "half")) << step;
    const auto place = std::filesystem::path("checkpoints/step_0000000012/membrane.vtu");
    EXPECT_TRUE(read_file(directory_ / "whole" / place) == read_file(directory_ / "half" / place)) << step;
  }
}

// 42 nodes a capsule: its 0th, and the elastic one between them.
TEST_P(LoadedRun, TheLoadIsInTheForceUpToItsEnd) {
  record(4);
  for (int step = 5; step <= 12; ++step) {
    const auto name = (step < 10 ? "000000000" : "00000000") + std::to_string(step) + ".vtu";
    if (step % 2 != 0) continue;  // a membrane file every other step
    const auto load = vectors("out/membrane/membrane_" + name, "load_force");
    const auto elastic = vectors("out/membrane/membrane_" + name, "elastic_force");
    const auto force = vectors("record/explicit_force/explicit_force_" + name, "total_force");
    EXPECT_EQ(load.leftCols(42).norm() > 0, step < 7) << step;
    EXPECT_EQ(load.middleCols(42, 42).norm(), 0);
    EXPECT_GT(load.rightCols(42).norm(), 0);
    // The forces without implicit viscous ones are those of the law and the load: sums of six numbers.
    EXPECT_LT((force - elastic - load).cwiseAbs().maxCoeff(), 1e-14 * force.cwiseAbs().maxCoeff()) << step;
  }
}

TEST_F(Stages, WithoutALoadThereIsNoArrayOfIt) {
  stage({"membrane", "--out", path("start.vtu")});
  const auto file = exchange::read_surface(path("start.vtu"));
  EXPECT_EQ(exchange::find_optional_array(file.point_data, "load_force"), nullptr);
}

}  // namespace
}  // namespace tanktread::testing
