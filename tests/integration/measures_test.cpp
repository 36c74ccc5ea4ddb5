// measures.csv: what is in a row, and that the table goes on with the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <sstream>

#include "driver/observe/measures.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "tests/integration/resume_fixture.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/// Flow along y, walls across x: the vorticity is along z.
constexpr const char* turned_case = R"([flow]
box = [24, 26, 22]
wall_axis = "x"
flow_axis = "y"
wall_speed = 0.012
[[capsule]]
radius = 5.0
position = [12.0, 13.0, 11.0]
mesh = { level = 3 }
[membrane]
capillary_number = 0.3
)";

/// Its system with the nodes turned about the vorticity axis by an angle, and moving on so at a rate, besides
/// a drift.
System turned(const Case& the_case, double angle, double rate) {
  const auto p = parameters(the_case);
  auto system = make_system(the_case, p, membrane_shapes(the_case));
  const Eigen::Vector3d centre(12, 13, 11), drift(0.01, -0.02, 0.003), now = centre + 3 * drift;
  Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3Xd arms = rotation * (system.membranes[0].positions().colwise() - centre);
  system.membranes[0].set_positions(arms.colwise() + now);
  for (Eigen::Index node = 0; node < arms.cols(); ++node)
    system.node_velocity[0].col(node) = drift + rate * Eigen::Vector3d::UnitZ().cross(arms.col(node));
  return system;
}

TEST(Measures, OfASphereThatTurns) {
  const auto the_case = parse_case(turned_case, "turned.toml", "/");
  const double g = parameters(the_case).shear_rate;
  for (const double angle : {0.0, 0.3, 2.0}) {
    const auto row = measure(turned(the_case, angle, -0.5 * g), the_case).at(0);
    // An icosphere of level 3 leaves out up to 1 - cos(edge/2) of the radius, 0.006 with edges of 0.15 to
    // 0.16 of it; less along a contour.
    EXPECT_NEAR(row.circumference, 1, 0.006);
    EXPECT_LT(row.circumference, 1);
    EXPECT_NEAR(row.membrane_speed, 0.5, 0.003);
    EXPECT_NEAR(row.vorticity_extent, 1, 0.006);
    // The node nearest to the flow axis turns with the others. An icosphere has nodes on the axes.
    EXPECT_NEAR(row.marker[0], -std::sin(angle), 1e-12);
    EXPECT_NEAR(row.marker[1], std::cos(angle), 1e-12);
    EXPECT_NEAR(row.marker[2], 0, 1e-12);
  }
}

// An ellipsoid of three axes, turned about the vorticity (z) from its place in the sphere: flow y, walls
// across x. Its nodes carry the z axis of the mesh; of the sphere they are the linear map itself.
TEST(Measures, OfAnEllipsoidThatTurns) {
  const auto the_case =
      parse_case(turned_case, "turned.toml", "/",
                 {"capsule.0.load.direction=[0, -7, 0]", "capsule.0.mesh.euler_angles=[0, 90, 0]"});
  const auto p = parameters(the_case);
  // About the new x by 90 degrees: the axis of the mesh is along -y.
  auto system = make_system(the_case, p, membrane_shapes(the_case));
  const Eigen::Vector3d centre(12, 13, 11), semi_axes(1.3, 0.6, 1.1);
  const auto start = system.membranes[0].positions();
  for (const double angle : {0.1, 0.3, 1.2, 2.0, -2.5}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d map = turn * semi_axes.asDiagonal();
    system.membranes[0].set_positions((map * (start.colwise() - centre)).colwise() + centre);
    const auto row = measure(system, the_case).at(0);
    const Eigen::Vector3d axis = (map * -Eigen::Vector3d::UnitY()).normalized();
    EXPECT_LT((row.axis - axis).norm(), 1e-12) << angle;
    EXPECT_NEAR(row.axis_inclination_deg, std::atan2(axis.x(), axis.y()) * 180 / std::numbers::pi, 1e-9);
    // The shortest axis is along y of the sphere too, towards the upper wall (x).
    const Eigen::Vector3d shortest = axis.x() > 0 ? axis : -axis;
    EXPECT_LT((row.short_axis - shortest).norm(), 1e-9) << angle;
    const double inclination = std::atan(shortest.x() / shortest.y()) * 180 / std::numbers::pi;
    EXPECT_NEAR(row.short_inclination_deg, inclination, 1e-6);
    // Extents of an ellipsoid along y, and the larger one across it; with 642 nodes less by up to 0.6 %.
    const double along = std::hypot(1.3 * std::sin(angle), 0.6 * std::cos(angle));
    const double across = std::hypot(1.3 * std::cos(angle), 0.6 * std::sin(angle));
    EXPECT_NEAR(row.axial_diameter / along, 1, 0.006) << angle;
    EXPECT_NEAR(row.transverse_diameter / std::max(across, 1.1), 1, 0.006) << angle;
  }
}

class MeasuresTable : public Resume {
 protected:
  static constexpr const char* with_measures = "output.measures_every=0.04";

  void run(const std::string& name, const char* shear_time, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--shear-time", shear_time});
    const auto ended = run_program(run_to(name, more));
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
  }
  std::string table(const std::string& name) const { return read_file(directory_ / name / "measures.csv"); }
};

TEST_F(MeasuresTable, IsWrittenIfItIsAskedFor) {
  run("none", "0.1");
  EXPECT_FALSE(fs::exists(directory_ / "none/measures.csv"));
  run("all", "0.1", {"--set", with_measures});
  const auto text = table("all");
  EXPECT_THAT(text,
              StartsWith("step,shear_time,capsule,circumference,membrane_speed,vorticity_extent,"
                         "marker_x,marker_y,marker_z,axial_diameter,transverse_diameter,axis_x,axis_y,axis_z,"
                         "axis_inclination_deg,short_axis_x,short_axis_y,short_axis_z,"
                         "short_inclination_deg\n0,0,0,"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 4) << "steps 0, 24, 48 and the end, 60";
  // Nothing else is another.
  for (const char* file :
       {"observables.csv", "membrane.pvd", "parameters.toml", "checkpoints/step_0000000060/membrane.vtu"})
    EXPECT_EQ(read_file(directory_ / "none" / file), read_file(directory_ / "all" / file)) << file;
}

TEST_F(MeasuresTable, ARunGoesOnWithIt) {
  run("whole", "0.4", {"--set", with_measures});
  run("half", "0.3", {"--set", with_measures});
  for (const char* from : {"120", "180"}) {
    const auto run = copy_of_half("out");
    const auto ended = resume(run, {"--shear-time", "0.4", "--from-step", from});
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_EQ(table("out"), table("whole")) << from;
  }
}

TEST_F(MeasuresTable, ARunThatIsKilledGoesOnWithIt) {
  expect_killed_run_goes_on({"--set", with_measures});
}

TEST_F(MeasuresTable, MustBeThereOnResume) {
  run("half", "0.3", {"--set", with_measures});
  const auto gone = copy_of_half("gone");
  fs::remove(gone / "measures.csv");
  const auto short_of_rows = copy_of_half("short");
  keep_lines(short_of_rows / "measures.csv", 3);
  for (const auto& [run, said] :
       {std::pair{gone, "measures.csv: is missing"}, {short_of_rows, "measures.csv: holds 2 of 8 rows"}}) {
    const auto before = contents_of(run);
    const auto refused = resume(run, {"--shear-time", "0.4"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr(said));
    EXPECT_EQ(contents_of(run), before);
    EXPECT_EQ(resume(run, {"--shear-time", "0.4", "--accept-gaps"}).exit_code, 0);
  }
}

TEST_F(MeasuresTable, CanBeginAndEndWithAResumedRun) {
  run_half();
  const auto run = copy_of_half("out");
  replace_in(run / "echo.toml", "measures_every = 0.0", "measures_every = 0.05");
  ASSERT_EQ(resume(run, {"--shear-time", "0.4"}).exit_code, 0);
  const auto text = table("out");
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 2) << text;  // 210, 240
  replace_in(run / "echo.toml", "measures_every = 0.05", "measures_every = 0.0");
  ASSERT_EQ(resume(run, {"--shear-time", "0.5"}).exit_code, 0);
  EXPECT_EQ(table("out"), text);
}

}  // namespace
