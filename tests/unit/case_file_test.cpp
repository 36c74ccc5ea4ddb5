// The case file: what is accepted, what is refused and in which words, and that the echo reproduces the case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "driver/case.hpp"
#include "driver/schema.hpp"
#include "driver/spelling.hpp"

namespace tanktread::driver {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* good_case = R"(title = "A \"good\" case"
[flow]
box = [60, 48, 40]
reynolds_number = 0.1
[[capsule]]
radius = 8.0
position = [30.0, 24.0, 20.0]
[membrane]
capillary_number = 0.3
)";

Case parse(const std::string& text, const std::vector<std::string>& assignments = {}) {
  return parse_case(text, "good.toml", "/nowhere", assignments);
}

std::string refusal(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    parse(text, assignments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST(CaseFile, FillsInDefaults) {
  const auto c = parse(good_case);
  EXPECT_EQ(c.title, "A \"good\" case");
  EXPECT_EQ(c.flow.kind, "shear");
  EXPECT_EQ(c.flow.box, (std::array<int, 3>{60, 48, 40}));
  EXPECT_EQ(c.flow.wall_axis, 2);
  EXPECT_EQ(c.flow.magic_parameter, 0.1875);
  ASSERT_EQ(c.capsules.size(), 1u);
  EXPECT_EQ(c.capsules[0].mesh.level, 3);
  EXPECT_EQ(c.capsules[0].membrane.capillary_modulus, "E_s");
  EXPECT_EQ(c.coupler.kernel, "cosine4");
}

struct BadInput {
  const char* name;
  std::vector<std::string> assignments;
  std::vector<std::string> words;  ///< all must be in the message
};

class BadCase : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadCase, IsRefusedInClearWords) {
  const auto message = refusal(good_case, GetParam().assignments);
  for (const auto& word : GetParam().words) EXPECT_THAT(message, HasSubstr(word));
}

INSTANTIATE_TEST_SUITE_P(
    Driver, BadCase,
    ::testing::Values(
        BadInput{"unknown",
                 {"flow.reynolds_nmber=1"},
                 {"--set flow.reynolds_nmber=1: ", "unknown key", "did you mean flow.reynolds_number?"}},
        BadInput{"unknown_table", {"fluid.box=[1,2,3]"}, {"fluid", "unknown key"}},
        BadInput{"wrong_type",
                 {"flow.relaxation_time=\"slow\""},
                 {"flow.relaxation_time", "must be a number > 0.5", "default 1.0"}},
        BadInput{"real_for_integer",
                 {"capsule.0.mesh.level=2.5"},
                 {"capsule.0.mesh.level=2.5", "an integer >= 0 and <= 8"}},
        BadInput{"out_of_range", {"flow.relaxation_time=0.5"}, {"flow.relaxation_time=0.5: ", "> 0.5"}},
        BadInput{"not_finite",
                 {"flow.reynolds_number=nan"},
                 {"flow.reynolds_number", "is not finite", "a number > 0"}},
        BadInput{"choice", {"flow.collision=\"trr\""}, {"one of \"trt\", \"bgk\"", "did you mean \"trt\"?"}},
        BadInput{"contradiction",
                 {"flow.wall_speed=0.01"},
                 {"flow.wall_speed", "contradicts flow.reynolds_number"}},
        BadInput{"magic_of_bgk",
                 {"flow.collision=\"bgk\"", "flow.magic_parameter=0.25"},
                 {"flow.magic_parameter", "contradicts collision = \"bgk\""}},
        BadInput{"same_axes", {"flow.flow_axis=\"z\""}, {"flow.flow_axis", "wall axis too"}},
        BadInput{"gamma_of_skalak",
                 {"membrane.capillary_modulus=\"gamma\""},
                 {"capillary_modulus", "contradicts elastic_law = \"skalak\"", "give \"E_s\""}},
        BadInput{"area_ratio_of_neo",
                 {"membrane.elastic_law=\"neo-hookean\"", "membrane.area_ratio=1.0"},
                 {"membrane.area_ratio", "neo-hookean", "it is of skalak"}},
        BadInput{"own_membrane",
                 {"capsule.0.membrane.poisson_ratio=0.3"},
                 {"capsule.0.membrane.poisson_ratio", "it is of hookean"}},
        BadInput{
            "near_wall",
            {"capsule.0.position.2=9.9"},
            {"capsule.0.position", "1.9 grid steps between capsule and wall", "kernel cosine4 reaches 2"}},
        BadInput{"meets_itself",
                 {"capsule.0.radius=24.0", "flow.box.2=80", "capsule.0.position.2=40.0"},
                 {"periodic image, 48 grid steps away along y"}},
        BadInput{"outside", {"capsule.0.position.0=61.0"}, {"outside the box", "x must be from 0 to 60"}},
        BadInput{"viscosity_ratio", {"flow.viscosity_ratio=5.0"}, {"flow.viscosity_ratio", "only 1"}},
        BadInput{"viscous",
                 {"membrane.viscous.scheme=\"fd\""},
                 {"membrane.viscous.scheme", "viscous laws are the next component to come"}},
        BadInput{
            "no_such_capsule", {"capsule.1.radius=3.0"}, {"--set capsule.1.radius", "there is 1 capsule"}},
        BadInput{"no_value", {"flow.box"}, {"--set flow.box", "key=value"}},
        BadInput{
            "mesh_file", {"capsule.0.mesh.file=\"none.vtu\""}, {"capsule.0.mesh.file", "/nowhere/none.vtu"}},
        BadInput{"fluid_box",
                 {"output.fluid_box=[[0,59],[24,24],[0,40]]"},
                 {"output.fluid_box", "along z it must be [first, last] with 0 <= first <= last <= 39"}},
        BadInput{"periodic", {"flow.kind=\"periodic\""}, {"flow.reynolds_number", "shear_rate"}},
        BadInput{"shear_rate", {"flow.shear_rate=1e-4"}, {"flow.shear_rate", "periodic"}},
        BadInput{"si",
                 {"si.radius_m=1e-6"},
                 {"si.shear_rate_per_s", "is missing", "contradicts [si]", "exactly one"}},
        BadInput{"table_for_value", {"flow=3"}, {"flow", "must be a table"}}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(CaseFile, ReportsAllProblemsWithTheirLines) {
  const auto message = refusal("[flow]\nbox = [60, 60]\ncolision = \"trt\"\n[[capsule]]\nradius = -1\n");
  EXPECT_THAT(
      message,
      AllOf(HasSubstr("good.toml:2: flow.box"), HasSubstr("good.toml:3: flow.colision"),
            HasSubstr("did you mean flow.collision?"), HasSubstr("good.toml:5: capsule.0.radius = -1"),
            HasSubstr("capsule.0.position: is missing"), HasSubstr("membrane.capillary_number: is missing")));
  EXPECT_THAT(refusal("[flow\n"), AllOf(HasSubstr("good.toml:1"), HasSubstr("not valid TOML")));
  EXPECT_THAT(refusal("[flow]\nbox=[60,60,60]\nwall_speed=0.01\n"), HasSubstr("[[capsule]]"));
  EXPECT_THROW(read_case("/nowhere/none.toml"), InputError);
}

TEST(CaseFile, SetTakesTomlValuesAndBareWords) {
  const auto c = parse(good_case, {"capsule.0.radius=7", "flow.box=[36,40,44]", "flow.box.2=46",
                                   "membrane.elastic_law=neo-hookean",
                                   "capsule.0.position=[18.0, 20.0, 23.0]", "flow.inertia=false"});
  EXPECT_EQ(c.capsules[0].radius, 7.0);
  EXPECT_EQ(c.flow.box, (std::array<int, 3>{36, 40, 46}));
  EXPECT_EQ(c.capsules[0].membrane.elastic_law, "neo-hookean");
  EXPECT_EQ(c.capsules[0].membrane.capillary_modulus, "G_s");
  EXPECT_FALSE(c.flow.inertia);
}

TEST(CaseFile, CapsulesOverrideTheMembraneTable) {
  const std::string second =
      "[[capsule]]\nradius = 5.0\nposition = [6.0, 6.0, 20.0]\n[capsule.membrane]\ncapillary_number = 0.1\n";
  const auto c = parse(good_case + second);
  ASSERT_EQ(c.capsules.size(), 2u);
  EXPECT_EQ(c.capsules[0].membrane.capillary_number, 0.3);
  EXPECT_EQ(c.capsules[1].membrane.capillary_number, 0.1);
  EXPECT_EQ(c.capsules[1].membrane.elastic_law, "skalak");
  // Across the periodic faces these two would overlap.
  EXPECT_THAT(refusal(good_case + second, {"capsule.0.position=[58.0, 46.0, 20.0]"}),
              HasSubstr("overlaps capsule 0"));
}

void expect_same(const Case& a, const Case& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_TRUE(a.flow == b.flow);
  EXPECT_TRUE(a.capsules == b.capsules);
  EXPECT_TRUE(a.coupler == b.coupler);
  EXPECT_TRUE(a.run == b.run);
  EXPECT_TRUE(a.output == b.output);
  EXPECT_TRUE(a.si == b.si);
}

TEST(CaseFile, EchoReadsBackAsTheSameCase) {
  const std::vector<std::vector<std::string>> variants = {
      {},
      {"flow.relaxation_time=0.1", "flow.relaxation_time=0.7123456789012345", "run.shear_time=1e-7"},
      {"flow.collision=bgk", "flow.start=developed", "flow.body_force=[1e-7, 0.0, -3.5e-9]"},
      {"flow.kind=poiseuille", "flow.wall_axis=y", "capsule.0.position.1=24.0", "flow.flow_axis=z"},
      {"membrane.elastic_law=hookean", "membrane.poisson_ratio=0.25"},
      {"membrane.elastic_law=interfacial-tension", "output.fluid_box=[[0,59],[24,24],[0,39]]"},
  };
  for (const auto& assignments : variants) {
    const auto c = parse(good_case, assignments);
    expect_same(c, parse(to_toml(c)));
  }
}

constexpr const char* si_case = R"([flow]
box = [60, 60, 60]
[[capsule]]
radius = 8.0
position = [30.0, 30.0, 30.0]
[si]
radius_m = 4e-6
shear_rate_per_s = 100.0
viscosity_Pa_s = 1e-3
density_kg_per_m3 = 1000.0
shear_modulus_N_per_m = 4e-6
)";

TEST(CaseFile, SiFormGivesTheDimensionlessNumbers) {
  const auto c = parse(si_case);
  // Ca = 1e-3 * 100 * 4e-6/4e-6 = 0.1 and Re = 1000 * 100 * 16e-12/1e-3 = 1.6e-3, to the rounding of three
  // operations.
  EXPECT_NEAR(c.capsules[0].membrane.capillary_number, 0.1, 1e-15);
  EXPECT_EQ(c.capsules[0].membrane.capillary_modulus, "G_s");
  EXPECT_NEAR(*c.flow.reynolds_number, 1.6e-3, 1e-17);
  expect_same(c, parse(to_toml(c)));
  const auto faster = parse(si_case, {"flow.reynolds_number=0.1"});
  EXPECT_EQ(*faster.flow.reynolds_number, 0.1);
  expect_same(faster, parse(to_toml(faster)));
}

TEST(Schema, HintsBySpelling) {
  EXPECT_EQ(nearest_spelling("membran", {"membrane", "flow"}), "membrane");
  EXPECT_EQ(nearest_spelling("xyz", {"membrane", "flow"}), "");
}

TEST(Schema, ManualListsEveryKey) {
  std::ifstream file(TANKTREAD_SOURCE_DIR "/docs/case-file.md");
  std::ostringstream manual;
  manual << file.rdbuf();
  EXPECT_THAT(manual.str(), HasSubstr(schema_markdown())) << "docs/case-file.md must hold this table:\n"
                                                          << schema_markdown();
}

}  // namespace
}  // namespace tanktread::driver
