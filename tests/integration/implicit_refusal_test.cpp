// What the stage of implicit viscous forces refuses.
#include <algorithm>
#include <limits>

#include "exchange/vtk_files.hpp"
#include "tests/integration/implicit_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(Implicit, BadInputOfTheStageIsRefusedAndNothingIsWritten) {
  stage({"membrane", "--out", path("start.vtu")});
  stage({"membrane", "--in", path("start.vtu"), "--out", path("membrane.vtu")});
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--fields", path("flow.vti"), "--free",
         path("free.vti")});
  const auto refusal = [&](std::vector<std::string> more, int code = 2) {
    std::vector<std::string> arguments = {"implicit",       "--in",  path("membrane.vtu"), "--grid",
                                          path("free.vti"), "--out", path("none.vtu")};
    for (std::size_t k = 0; k + 1 < more.size(); k += 2) {
      const auto at = std::ranges::find(arguments, more[k]);
      if (at == arguments.end()) {
        arguments.insert(arguments.end(), {more[k], more[k + 1]});
      } else {
        *(at + 1) = more[k + 1];
      }
    }
    const auto output = stage(arguments, code);
    EXPECT_FALSE(std::filesystem::exists(path("none.vtu")));
    return output;
  };
  EXPECT_THAT(refusal({"--grid", path("flow.vti")}),
              AllOf(HasSubstr("flow.vti: array 'mobility' is missing"), HasSubstr("tanktread fluid --free")));
  EXPECT_THAT(refusal({"--in", path("nowhere.vtu")}), HasSubstr("nowhere.vtu: no such file"));
  EXPECT_THAT(refusal({"--grid", path("nowhere.vti")}), HasSubstr("nowhere.vti: no such file"));
  EXPECT_THAT(refusal({"--out", path("none.vti")}), HasSubstr("none.vti"));
  EXPECT_THAT(refusal({"--out", path("membrane.vtu")}), HasSubstr("is the file that --in names"));
  // Files that do not say which forces are without the viscous ones: those would be added twice.
  EXPECT_THAT(refusal({"--in", path("start.vtu")}), HasSubstr("array 'explicit_force' is missing"));
  stage({"implicit", "--in", path("membrane.vtu"), "--grid", path("free.vti"), "--out", path("done.vtu")});
  EXPECT_THAT(refusal({"--in", path("done.vtu")}), HasSubstr("give --out of `tanktread membrane`"));
  // Numbers that are none.
  auto bad = exchange::read_grid(path("free.vti"));
  bad.point_data[0].values[3 * 100 + 1] = std::numeric_limits<double>::quiet_NaN();
  exchange::write_grid(path("bad.vti"), bad);
  EXPECT_THAT(refusal({"--grid", path("bad.vti")}), HasSubstr("bad.vti: node 100 has the velocity"));
  bad = exchange::read_grid(path("free.vti"));
  bad.point_data[1].values[7] = -0.5;
  exchange::write_grid(path("bad.vti"), bad);
  EXPECT_THAT(refusal({"--grid", path("bad.vti")}), HasSubstr("and the mobility -0.5"));
  // A file of positions and forces that has no history.
  record(10);
  EXPECT_THAT(refusal({"--in", path("record/explicit_force/explicit_force_0000000012.vtu")}),
              AllOf(HasSubstr("explicit_force_0000000012.vtu"), HasSubstr("is missing")));
  // A free velocity on the nodes of other stencils.
  auto grid = exchange::read_grid(path("record/free_velocity/free_velocity_0000000012.vti"));
  for (auto& array : grid.point_data) {
    if (array.name == "touched") std::ranges::fill(array.values, 0.0);
  }
  exchange::write_grid(path("few.vti"), grid);
  EXPECT_THAT(
      refusal({"--grid", path("few.vti")}),
      AllOf(HasSubstr("few.vti: no free velocity on grid node "), HasSubstr("which a stencil touches")));
  for (auto& array : grid.point_data) {
    if (array.name == "touched") array.values[4000] = 1;
  }
  exchange::write_grid(path("few.vti"), grid);
  EXPECT_THAT(
      refusal({"--grid", path("few.vti")}),
      AllOf(HasSubstr("few.vti: no free velocity on grid node "), HasSubstr("which a stencil touches")));
  EXPECT_THAT(refusal({"--set", "flow.box=[30, 16, 20]"}), HasSubstr("flow.box = [30, 16, 20]"));
  EXPECT_THAT(refusal({"--set", "coupler.implicit_tolerance=0"}), HasSubstr("a number > 0"));
}

TEST_F(Implicit, ACaseWithoutItHasNothingToDoInTheStage) {
  const std::vector<std::string> none = {"--set", "capsule.0.membrane.viscous.scheme=none", "--set",
                                         "capsule.2.membrane.viscous.scheme=none"};
  const auto elastic_stage = [&](std::vector<std::string> arguments, int code) {
    arguments.insert(arguments.end(), none.begin(), none.end());
    return stage(arguments, code);
  };
  elastic_stage({"membrane", "--out", path("membrane.vtu")}, 0);
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--free", path("free.vti")});
  EXPECT_THAT(elastic_stage({"implicit", "--in", path("membrane.vtu"), "--grid", path("free.vti"), "--out",
                             path("none.vtu")},
                            2),
              AllOf(HasSubstr("no capsule has an implicit viscosity"), HasSubstr("or leave the stage out")));
  EXPECT_FALSE(std::filesystem::exists(path("none.vtu")));
}

TEST_F(Implicit, TheFreeVelocityHasAPlaceOfItsOwn) {
  const std::vector<std::string> fluid = {"fluid", "--steps", "0", "--out", path("fluid.vti")};
  for (const auto& [option, other] : {std::pair("--fields", "--free"), std::pair("--free", "--fields")}) {
    auto arguments = fluid;
    arguments.insert(arguments.end(), {option, path("same.vti"), other, path("./same.vti")});
    EXPECT_THAT(stage(arguments, 2), HasSubstr("name one file"));
  }
  auto arguments = fluid;
  arguments.insert(arguments.end(), {"--free", path("fluid.vti")});
  EXPECT_THAT(stage(arguments, 2), HasSubstr("--free and --out name one file"));
  for (const char* none : {"same.vti", "fluid.vti"}) EXPECT_FALSE(std::filesystem::exists(path(none)));
}

}  // namespace
}  // namespace tanktread::testing
