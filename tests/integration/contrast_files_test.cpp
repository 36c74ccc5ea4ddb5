// What files of a run say of the fluid inside capsules, and which marks are refused.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "driver/units/flow_units.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/integration/contrast_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The volume in one of two capsules that have as many triangles.
double volume(const exchange::SurfacePacket& surface, std::size_t capsule) {
  const auto n_numbers = surface.triangles.size() / 2;
  double sum = 0;
  for (std::size_t k = capsule * n_numbers; k < (capsule + 1) * n_numbers; k += 3) {
    const auto corner = [&](std::size_t c) {
      return Eigen::Map<const Eigen::Vector3d>(&surface.points[3 * std::size_t(surface.triangles[k + c])]);
    };
    sum += corner(0).cross(corner(1)).dot(corner(2)) / 6;
  }
  return sum;
}

TEST_F(Contrast, FluidFilesAndStatesHaveTheMarksOfTheirSurfaces) {
  call({"run", path("case.toml"), "--output", path("out"), "--record", path("record")});
  const auto viscosities = driver::viscosities_of_marks(driver::read_case(path("case.toml")));
  for (const int step : {0, 6, contrast_steps}) {
    stage({"coupler", "mark", "--in", path("out/membrane/" + numbered("membrane", step) + ".vtu"), "--out",
           path("inside.vti")});
    EXPECT_FALSE(has(path("inside.vti"), "touched"));
    const auto marks = values(path("inside.vti"), "inside");
    ASSERT_EQ(marks.size(), contrast_nodes);
    EXPECT_TRUE(values(path("out/fluid/" + numbered("fluid", step) + ".vti"), "inside") == marks) << step;
    double count[3] = {};
    for (const double mark : marks) ++count[static_cast<int>(mark)];
    // As many as the volume of the mesh; of the some 100 nodes that are within half a grid step of it, half
    // are inside, give or take 5, by the binomial law.
    const auto surface = exchange::read_surface(path("out/membrane/" + numbered("membrane", step) + ".vtu"));
    EXPECT_NEAR(count[1], volume(surface, 0), 15) << step;
    EXPECT_NEAR(count[2], volume(surface, 1), 15) << step;
    if (step == 0) continue;
    EXPECT_TRUE(values(path("record/inside/" + numbered("inside", step) + ".vti"), "inside") == marks);
    if (step != contrast_steps) continue;
    const auto of_state = values(checkpoint("out", "fluid.vti"), "viscosity");
    for (std::size_t node = 0; node < marks.size(); ++node)
      ASSERT_EQ(of_state[node], viscosities[static_cast<std::size_t>(marks[node])]) << node;
  }
}

TEST_F(Contrast, AFluidFileOfAPartHasTheMarksOfThatPart) {
  call({"run", path("case.toml"), "--output", path("out")});
  call({"run", path("case.toml"), "--output", path("part"), "--set",
        "output.fluid_box=[[4, 20], [8, 8], [5, 12]]"});
  const auto file = numbered("/fluid/fluid", contrast_steps) + ".vti";
  const auto all = values(path("out" + file), "inside"), some = values(path("part" + file), "inside");
  ASSERT_EQ(some.size(), 17U * 8U);
  std::size_t k = 0;
  for (int z = 5; z <= 12; ++z)
    for (int x = 4; x <= 20; ++x)
      EXPECT_EQ(some[k++], all[static_cast<std::size_t>(x + 26 * (8 + 16 * z))]) << x << " " << z;
}

TEST_F(Contrast, OneViscosityHasNoneOfIt) {
  // As where nothing is said of viscosities.
  auto text = read_file(path("case.toml"));
  for (const std::string line : {"viscosity_ratio = 5.0\n", "viscosity_ratio = 0.5\n"})
    text.replace(text.find(line), line.size(), "");
  std::ofstream(path("plain.toml")) << text;
  std::vector<std::string> one = {"run",       path("case.toml"), "--output",
                                  path("one"), "--record",        path("record")};
  one.insert(one.end(), no_contrast.begin(), no_contrast.end());
  call(one);
  call({"run", path("plain.toml"), "--output", path("plain")});
  EXPECT_EQ(result_files(path("one")), result_files(path("plain")));
  expect_same_end("one", "plain");
  for (const char* none : {"record/inside", "record/inside.pvd"})
    EXPECT_FALSE(std::filesystem::exists(path(none))) << none;
  EXPECT_FALSE(has(path("one/fluid/" + numbered("fluid", contrast_steps) + ".vti"), "inside"));
  EXPECT_FALSE(has(checkpoint("one", "fluid.vti"), "viscosity"));
}

TEST_F(Contrast, MarksThatAreNoneAreRefusedAndNothingIsWritten) {
  stage({"membrane", "--out", path("membrane.vtu")});
  stage({"coupler", "mark", "--in", path("membrane.vtu"), "--out", path("inside.vti")});
  const auto good = exchange::read_grid(path("inside.vti"));
  const auto refusal = [&](const exchange::GridPacket& marks, const std::vector<std::string>& more = {}) {
    exchange::write_grid(path("bad.vti"), marks);
    std::vector<std::string> arguments = {"fluid", "--inside", path("bad.vti"), "--out", path("none.vti")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto output = stage(arguments, 2);
    EXPECT_FALSE(std::filesystem::exists(path("none.vti")));
    return output;
  };
  for (const double mark : {-1.0, 3.0, 0.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto bad = good;
    bad.point_data[0].values[100] = mark;
    EXPECT_THAT(refusal(bad), AllOf(HasSubstr("bad.vti: 'inside' of node 100 is "),
                                    HasSubstr("the number of a capsule from 1 to 2")))
        << mark;
  }
  auto bad = good;
  bad.point_data[0].name = "marks";
  EXPECT_THAT(refusal(bad), HasSubstr("bad.vti: array 'inside' is missing"));
  bad = good;
  bad.point_data[0].components = 3;
  bad.point_data[0].values.resize(3 * contrast_nodes);
  EXPECT_THAT(refusal(bad), HasSubstr("'inside' has 3 components"));
  EXPECT_THAT(refusal(good, {"--set", "flow.box=[26, 16, 20]"}), HasSubstr("flow.box = [26, 16, 20]"));
  EXPECT_THAT(stage({"fluid", "--inside", path("nowhere.vti"), "--out", path("none.vti")}, 2),
              HasSubstr("nowhere.vti: no such file"));
  EXPECT_THAT(stage({"fluid", "--inside", path("inside.vti"), "--out", path("inside.vti")}, 2),
              HasSubstr("is the file that --inside names"));
  EXPECT_FALSE(std::filesystem::exists(path("none.vti")));
}

TEST_F(Contrast, SurfacesThatShareANodeAreRefusedWhereTheyAreMarked) {
  record(10);
  const auto positions = path("record/positions/" + numbered("positions", 12) + ".vtu");
  auto surface = exchange::read_surface(positions);
  const auto n_each = surface.points.size() / 2;  // both meshes have as many nodes
  for (std::size_t k = 0; k < n_each; k += 3) surface.points[n_each + k] -= 9.0;
  exchange::write_surface(positions, surface);
  EXPECT_THAT(stage({"coupler", "mark", "--in", positions, "--out", path("none.vti")}, 2),
              AllOf(HasSubstr("positions_0000000012.vtu"), HasSubstr("surface 1")));
  EXPECT_FALSE(std::filesystem::exists(path("none.vti")));
  EXPECT_THAT(stage({"coupler", "mark", "--in", path("nowhere.vtu"), "--out", path("none.vti")}, 2),
              HasSubstr("nowhere.vtu: no such file"));
  EXPECT_THAT(stage({"coupler", "mark", "--in", positions, "--out", positions}, 2), HasSubstr(".vti"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "coupler"}, 2), HasSubstr("surface 1"));

  call({"run", path("case.toml"), "--output", path("half"), "--shear-time", "0.04"});
  auto state = exchange::read_surface(checkpoint("half", "membrane.vtu", 10));
  for (std::size_t k = 0; k < n_each; k += 3) state.points[n_each + k] -= 9.0;
  exchange::write_surface(checkpoint("half", "membrane.vtu", 10), state);
  EXPECT_THAT(call({"run", "--resume", path("half"), "--shear-time", "0.048"}, 2),
              AllOf(HasSubstr("step_0000000010"), HasSubstr("surface 1")));
}

}  // namespace
}  // namespace tanktread::testing
