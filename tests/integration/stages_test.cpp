// The stages: each component by itself from files, which must be the fused run bit for bit, and what they
// refuse.
#include <cmath>

#include "exchange/vtk_files.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StagedRun : public CorrectedOrNot {};
INSTANTIATE_TEST_SUITE_P(Stages, StagedRun, ::testing::Bool(), name_of_correction);

TEST_P(StagedRun, EqualsTheFusedOne) {
  record();
  stage({"membrane", "--out", path("membrane.vtu")});
  const auto start = exchange::read_surface(path("membrane.vtu"));
  for (const char* array : {"velocity", "total_force"}) {
    EXPECT_THAT(exchange::find_array(start.point_data, array, "the start").values, ::testing::Each(0.0))
        << array;
  }
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--fields", path("flow.vti")});
  for (int step = 0; step < 20; ++step) {
    stage({"coupler", "interpolate", "--in", path("membrane.vtu"), "--grid", path("flow.vti"), "--out",
           path("velocity.vtu")});
    stage({"membrane", "--in", path("velocity.vtu"), "--move", "--state", path("membrane.vtu"), "--out",
           path("membrane.vtu")});
    stage({"coupler", "spread", "--in", path("membrane.vtu"), "--out", path("force.vti")});
    stage({"fluid", "--state", path("fluid.vti"), "--force", path("force.vti"), "--out", path("fluid.vti"),
           "--fields", path("flow.vti")});
  }
  // Whole files, byte for byte: every array with its name, shape and bits.
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/end/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/end/fluid.vti")));
  EXPECT_THAT(call({"diff", path("membrane.vtu"), path("record/end/membrane.vtu")}), HasSubstr("identical"));
}

TEST_P(StagedRun, ThroughFilesEqualsInMemory) {
  call({"run", path("case.toml"), "--output", path("memory")});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  for (const char* packet :
       {"grid_velocity.vti", "node_velocity.vtu", "positions.vtu", "node_force.vtu", "grid_force.vti"}) {
    EXPECT_TRUE(std::filesystem::exists(directory_ / "files" / "packets" / packet)) << packet;
  }
  std::filesystem::remove_all(directory_ / "files" / "packets");
  EXPECT_EQ(result_files(directory_ / "memory"), result_files(directory_ / "files"));
  for (const char* file : {"fluid.vti", "membrane.vtu"}) {
    const auto place = std::filesystem::path("checkpoints/step_0000000020") / file;
    EXPECT_TRUE(read_file(directory_ / "memory" / place) == read_file(directory_ / "files" / place)) << file;
  }
}

TEST_F(Stages, AnyFileOfARunIsAnInput) {
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.fluid_every=0.04"});
  const auto membrane = path("out/membrane/membrane_0000000020.vtu"),
             flow = path("out/fluid/fluid_0000000020.vti");
  stage({"coupler", "interpolate", "--in", membrane, "--grid", flow, "--out", path("velocity.vtu")});
  stage({"coupler", "spread", "--in", membrane, "--out", path("force.vti"), "--set", "coupler.kernel=roma3"});
  stage({"membrane", "--in", membrane, "--out", path("forces.vtu")});
  stage({"fluid", "--state", path("out/checkpoints/step_0000000020/fluid.vti"), "--force", flow, "--steps",
         "3", "--out", path("fluid.vti")});
  // The spread keeps the sum of the forces, whatever the kernel: what is left is the rounding of some 200
  // nodal forces and 64 weights each, relative to the sum of their sizes.
  const auto forces = exchange::read_surface(membrane).point_data[2].values,
             grid = exchange::read_grid(path("force.vti")).point_data[0].values;
  double size = 0, sum = 0;
  for (std::size_t k = 0; k < forces.size(); ++k) size += std::abs(forces[k]), sum += forces[k];
  for (const double value : grid) sum -= value;
  EXPECT_GT(size, 0);
  EXPECT_LT(std::abs(sum), 1e-13 * size);
}

TEST_F(Stages, FluidAloneIsCouetteFlow) {
  // Walls at 0 and 20 with -+0.02: u_x = 0.02 (z - 10)/10. From rest, the slowest mode dies as exp(-pi^2 nu
  // t/L^2): with nu = 1/6, L = 20 and 12000 steps to 1e-21 of it, so that only rounding is left.
  stage({"fluid", "--steps", "12000", "--out", path("fluid.vti"), "--fields", path("flow.vti")});
  const auto flow = exchange::read_grid(path("flow.vti"));
  const auto& velocity = exchange::find_array(flow.point_data, "velocity", "flow").values;
  for (int z = 0; z < 20; ++z) {
    EXPECT_NEAR(velocity[static_cast<std::size_t>(3 * z * 26 * 18)], 0.02 * (z + 0.5 - 10) / 10, 1e-12) << z;
  }
}

TEST_F(Stages, MotionFromASeriesIsThatOfTheRun) {
  // A file a step, so that nothing is interpolated: the forces are then those of the run, without any fluid.
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.membrane_every=0.002"});
  stage({"membrane", "--motion", path("out/membrane.pvd"), "--out", path("motion")});
  for (const char* file : {"membrane_0000000001.vtu", "membrane_0000000007.vtu", "membrane_0000000020.vtu"}) {
    const auto run = exchange::read_surface(directory_ / "out" / "membrane" / file);
    const auto motion = exchange::read_surface(directory_ / "motion" / "membrane" / file);
    EXPECT_EQ(run.points, motion.points);
    for (const char* array : {"total_force", "elastic_force"}) {
      EXPECT_EQ(exchange::find_array(run.point_data, array, file).values,
                exchange::find_array(motion.point_data, array, file).values);
    }
    EXPECT_EQ(exchange::find_array(run.cell_data, "viscous_stress", file).values,
              exchange::find_array(motion.cell_data, "viscous_stress", file).values);
  }
}

TEST_F(Stages, MotionTakesASurfaceOnceThatASeriesNamesAgain) {
  // Every second entry of the one series repeats the file before it; the other has each file once.
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.fluid_every=0.002"});
  call({"run", path("case.toml"), "--output", path("plain"), "--set", "output.fluid_every=0"});
  auto entries = exchange::read_series(path("out/membrane.pvd"));
  ASSERT_EQ(entries.size(), 21U);
  ASSERT_EQ(exchange::read_series(path("plain/membrane.pvd")).size(), 11U);
  for (const std::string name : {"out", "plain"})
    stage({"membrane", "--motion", path(name + "/membrane.pvd"), "--out", path(name + "_motion")});
  const auto again = result_files(path("out_motion")), once = result_files(path("plain_motion"));
  EXPECT_EQ(once.size(), 12U);
  EXPECT_TRUE(again == once);
  // Without its first entry the series begins with a file at another time than its own.
  entries.erase(entries.begin());
  exchange::write_series(path("out/late.pvd"), entries);
  EXPECT_THAT(
      stage({"membrane", "--motion", path("out/late.pvd"), "--out", path("late")}, 2),
      HasSubstr("late.pvd: names membrane/membrane_0000000000.vtu at shear time 0.002, but the file is of "
                "shear time 0; name it at its own time"));
}

TEST_F(Stages, TwistReturnsToTheStart) {
  stage({"membrane", "--motion", "twist", "--amplitude-deg", "20", "--period", "0.4", "--shear-time", "0.4",
         "--every", "0.2", "--out", path("twist")});
  const auto start = exchange::read_surface(path("twist/membrane/membrane_0000000000.vtu"));
  const auto half = exchange::read_surface(path("twist/membrane/membrane_0000000100.vtu"));
  const auto end = exchange::read_surface(path("twist/membrane/membrane_0000000200.vtu"));
  double largest = 0, left = 0;
  for (std::size_t k = 0; k < start.points.size(); ++k) {
    largest = std::max(largest, std::abs(half.points[k] - start.points[k]));
    left = std::max(left, std::abs(end.points[k] - start.points[k]));
  }
  // Half way the equator is turned by 2 A0 = 40 degrees, 2 a sin(20 degrees) = 2.4 grid steps for a = 3.5; at
  // the end 1 - cos(2 pi) is rounding.
  EXPECT_GT(largest, 2.0);
  EXPECT_LT(left, 1e-12);
}

TEST_F(Stages, NothingIsWrittenForBadInput) {
  record();
  const auto force = path("record/node_force/node_force_0000000003.vtu"),
             positions = path("record/positions/positions_0000000003.vtu");
  EXPECT_THAT(stage({"coupler", "spread", "--in", positions, "--out", path("none.vti")}, 2),
              HasSubstr("positions_0000000003.vtu: array 'total_force' is missing"));
  EXPECT_THAT(stage({"coupler", "spread", "--in", path("nowhere.vtu"), "--out", path("none.vti")}, 2),
              HasSubstr("nowhere.vtu: no such file"));
  EXPECT_THAT(stage({"membrane", "--in", positions, "--move", "--out", path("none.vtu")}, 2),
              HasSubstr("array 'velocity' is missing"));
  EXPECT_THAT(stage({"membrane", "--in", positions, "--state", force, "--out", path("none.vtu")}, 2),
              HasSubstr("array 'history_0' is missing"));
  EXPECT_THAT(
      stage({"membrane", "--in", positions, "--out", path("none.vtu"), "--set", "capsule.1.mesh.level=2"}, 2),
      HasSubstr("capsule 1 has 42 nodes and 80 triangles, that of the case 162 and 320"));
  EXPECT_THAT(stage({"fluid", "--force", path("record/grid_force/grid_force_0000000003.vti"), "--out",
                     path("none.vti"), "--set", "flow.box=[26,18,22]"},
                    2),
              AllOf(HasSubstr("a grid of 26 x 18 x 20 nodes"), HasSubstr("flow.box = [26, 18, 22]")));
  EXPECT_THAT(stage({"fluid", "--state", path("record/begin/fluid.vti"), "--out", path("none.vti"), "--set",
                     "flow.box=[26,18,22]"},
                    2),
              AllOf(HasSubstr("a grid of 26 x 18 x 20 nodes"), HasSubstr("flow.box = [26, 18, 22]")));
  EXPECT_THAT(stage({"fluid", "--out", path("no/folder.vti")}, 2), HasSubstr("there is no folder"));
  EXPECT_THAT(stage({"fluid", "--out", path("none.vti"), "--fields", path("./none.vti")}, 2),
              HasSubstr("name one file"));
  EXPECT_THAT(stage({"membrane", "--out", directory_.path().string()}, 2), HasSubstr("is a folder"));
  for (const char* none : {"none.vti", "none.vtu"}) EXPECT_FALSE(std::filesystem::exists(path(none)));
}

/// A node_force packet of the record, changed.
template <class Change>
void change_packet(const std::string& file, Change change) {
  auto packet = exchange::read_surface(file);
  change(packet);
  exchange::write_surface(file, packet);
}

TEST_F(Stages, RefusesWhatIsNotThePacketThatItShouldBe) {
  record();
  const auto file = path("record/node_force/node_force_0000000003.vtu");
  const auto refusal = [&] {
    return stage({"coupler", "spread", "--in", file, "--out", path("none.vti")}, 2);
  };
  change_packet(file, [](auto& packet) { packet.field_data[1].values = {2}; });
  EXPECT_THAT(refusal(), HasSubstr("schema version 2 cannot be read, only up to 1"));
  change_packet(file, [](auto& packet) {
    packet.field_data[1].values = {1};
    packet.field_data[0].values = {2.5};
  });
  EXPECT_THAT(refusal(), HasSubstr("'step' must be one whole number"));
  change_packet(file, [](auto& packet) {
    packet.field_data[0].values = {3};
    packet.point_data[0].components = 1;
    packet.point_data[0].values.resize(204);
  });
  EXPECT_THAT(refusal(), HasSubstr("the array 'total_force' has 1 components; a vector has 3"));
}

TEST_F(Stages, ACorrectionNeedsTheForceOfTheNodes) {
  record();
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--fields", path("flow.vti")});
  const std::vector<std::string> arguments = {
      "coupler", "interpolate",    "--in",  path("record/positions/positions_0000000003.vtu"),
      "--grid",  path("flow.vti"), "--out", path("velocity.vtu")};
  stage(arguments);
  std::filesystem::remove(path("velocity.vtu"));
  correct();
  EXPECT_THAT(stage(arguments, 2), AllOf(HasSubstr("positions_0000000003.vtu"), HasSubstr("total_force"),
                                         HasSubstr("--set coupler.tangential_correction=false")));
  auto plain = arguments;
  plain.insert(plain.end(), {"--set", "coupler.tangential_correction=false"});
  stage(plain);
  std::filesystem::remove(path("velocity.vtu"));
  const auto forces = path("record/node_force/node_force_0000000003.vtu");
  change_packet(forces, [](auto& packet) { packet.point_data[0].values[3 * 5] = std::nan(""); });
  auto with_forces = arguments;
  with_forces[3] = forces;
  EXPECT_THAT(stage(with_forces, 2), AllOf(HasSubstr("node_force_0000000003.vtu"),
                                           HasSubstr("the force of node 5 of surface 0 is not finite")));
  EXPECT_FALSE(std::filesystem::exists(path("velocity.vtu")));
}

TEST_F(Stages, AStateIsOfTheStressFreeShapeOfTheCase) {
  call({"run", path("case.toml"), "--output", path("out")});
  const auto state = path("out/checkpoints/step_0000000020/membrane.vtu");
  const std::vector<std::string> go_on = {"membrane", "--in",  state,           "--state",
                                          state,      "--out", path("next.vtu")};
  EXPECT_THAT(stage(go_on), Not(HasSubstr("note:")));
  auto other = go_on;
  other.insert(other.end(), {"--set", "capsule.1.radius=3.1"});
  std::filesystem::remove(path("next.vtu"));
  EXPECT_THAT(stage(other, 2), AllOf(HasSubstr("membrane.vtu"), HasSubstr("capsule.1.radius")));
  EXPECT_FALSE(std::filesystem::exists(path("next.vtu")));
}

TEST_F(Stages, OtherSettingsThanThoseOfAStateAreSaid) {
  call({"run", path("case.toml"), "--output", path("out")});
  const std::string folder = path("out/checkpoints/step_0000000020/");
  const auto go_on = [&](const std::string& component, const std::string& set) {
    const std::string file = component == "fluid" ? "fluid.vti" : "membrane.vtu", state = folder + file;
    std::vector<std::string> arguments = {component, "--state", state, "--out", path(file), "--set", set};
    if (component == "membrane") arguments.insert(arguments.end(), {"--in", state});
    return stage(arguments);
  };
  EXPECT_THAT(
      go_on("fluid", "flow.relaxation_time=0.9"),
      AllOf(HasSubstr("note:"), HasSubstr("flow.relaxation_time: 1.0 in the case that made it, 0.9")));
  EXPECT_THAT(go_on("fluid", "membrane.capillary_number=0.2"), Not(HasSubstr("note:")));
  EXPECT_THAT(go_on("membrane", "capsule.1.membrane.viscous.scheme=fd"),
              HasSubstr("capsule.1.membrane.viscous.scheme: \"int2\" in the case that made it, \"fd\""));
}

TEST_F(Stages, RefusesPositionsBeyondAWall) {
  record(17);
  const auto force = path("record/node_force/node_force_0000000019.vtu"),
             positions = path("record/positions/positions_0000000019.vtu");
  for (const auto& file : {force, positions}) {
    change_packet(file, [](auto& packet) { packet.points[2] = 19.5; });  // the wall lies at 20
  }
  EXPECT_THAT(stage({"coupler", "spread", "--in", force, "--out", path("none.vti")}, 2), HasSubstr("wall"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}, 2), HasSubstr("wall"));
  for (const char* none : {"none.vti", "none.vtu"}) EXPECT_FALSE(std::filesystem::exists(path(none)));
}

TEST_F(Stages, RefusesCapsulesAndMarksOfAnotherForm) {
  record();
  const auto file = path("record/node_force/node_force_0000000003.vtu");
  const auto refusal = [&] {
    return stage({"coupler", "spread", "--in", file, "--out", path("none.vti")}, 2);
  };
  change_packet(file, [](auto& packet) {
    for (auto& number : packet.cell_data[0].values) number += 1;
  });
  EXPECT_THAT(refusal(), HasSubstr("'capsule' must count the capsules from 0"));
  const auto force = path("record/grid_force/grid_force_0000000003.vti");
  auto grid = exchange::read_grid(force);
  grid.point_data[1].components = 3;
  grid.point_data[1].values.resize(3 * grid.point_data[1].values.size());
  exchange::write_grid(force, grid);
  EXPECT_THAT(stage({"fluid", "--force", force, "--out", path("none.vti")}, 2),
              HasSubstr("'touched' has 3 components; 1 is needed"));
}

TEST_F(Stages, AViscousMotionBeginsAtRest) {
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.membrane_every=0.002"});
  auto entries = exchange::read_series(path("out/membrane.pvd"));
  entries.erase(entries.begin(), entries.begin() + 10);
  exchange::write_series(path("out/late.pvd"), entries);
  EXPECT_THAT(stage({"membrane", "--motion", path("out/late.pvd"), "--out", path("late")}, 2),
              HasSubstr("capsule 1 is deformed at the beginning"));
  stage({"membrane", "--motion", path("out/late.pvd"), "--out", path("late"), "--set",
         "capsule.1.membrane.viscous.scheme=none"});
}

TEST_F(Stages, RefusesAFlippedBit) {
  record();
  const auto file = path("record/node_force/node_force_0000000003.vtu");
  auto bytes = read_file(file);
  bytes[bytes.find("<AppendedData") + 600] ^= 1;  // among the numbers of total_force
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_THAT(stage({"coupler", "spread", "--in", file, "--out", path("none.vti")}, 2),
              HasSubstr("the contents are not those that were written"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane"}, 2),
              HasSubstr("node_force_0000000003.vtu"));
}

TEST_F(Stages, AMoveTooLongOrAnElementTurnedOverIsAFailedRun) {
  record();
  const auto velocity = path("record/node_velocity/node_velocity_0000000003.vtu"),
             positions = path("record/positions/positions_0000000003.vtu");
  change_packet(velocity, [](auto& packet) { packet.point_data[0].values[30] = 0.75; });
  EXPECT_THAT(stage({"membrane", "--in", velocity, "--move", "--out", path("none.vtu")}, 3),
              AllOf(HasSubstr("node 10 of capsule 0"), HasSubstr("would move by 0.75")));
  change_packet(positions, [](auto& packet) { packet.points[2] += 6; });
  EXPECT_THAT(stage({"membrane", "--in", positions, "--out", path("none.vtu")}, 3), HasSubstr("element"));
  for (const char* none : {"none.vti", "none.vtu"}) EXPECT_FALSE(std::filesystem::exists(path(none)));
}

}  // namespace
}  // namespace tanktread::testing
