// `--set key=value`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/units/units.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CaseSet, ValuesOfEveryKind) {
  const auto the_case =
      parse(least_case,
            {"title=\"A title\"", "capsule.0.radius=8", "flow.box=[36, 50, 44]", "flow.inertia=false",
             "run.threads=3", "flow.body_force=[1e-7, 0, 2]", "output.fluid_box=[[0, 1], [2, 3], [4, 5]]"});
  EXPECT_EQ(the_case.title, "A title");
  EXPECT_EQ(the_case.capsules[0].radius, 8.0);
  EXPECT_EQ(the_case.flow.box, (std::array<int, 3>{36, 50, 44}));
  EXPECT_FALSE(the_case.flow.inertia);
  EXPECT_EQ(the_case.run.threads, 3);
  EXPECT_EQ(the_case.flow.body_force, (std::array<double, 3>{1e-7, 0, 2}));
  EXPECT_EQ(the_case.output.fluid_box, (Ranges3{{{0, 1}, {2, 3}, {4, 5}}}));
}

TEST(CaseSet, ElementsOfArraysAndOfTheListOfCapsules) {
  const auto the_case =
      parse(full_case, {"flow.box.2=64", "capsule.1.position.0=28.5", "capsule.1.mesh.level=2"});
  EXPECT_EQ(the_case.flow.box, (std::array<int, 3>{40, 50, 64}));
  EXPECT_EQ(the_case.capsules[1].position, (std::array<double, 3>{28.5, 25, 30}));
  EXPECT_EQ(the_case.capsules[1].mesh.level, 2);
  EXPECT_EQ(the_case.capsules[0].mesh.level, 4);
  // Not in the file, but its default is known.
  EXPECT_EQ(parse(least_case, {"flow.body_force.2=1e-6"}).flow.body_force,
            (std::array<double, 3>{0, 0, 1e-6}));
}

TEST(CaseSet, ListsOfTexts) {
  using Texts = std::vector<std::string>;
  const auto the_case =
      parse(full_case, {"membrane.command=[\"sh\",\"x y\"]", "capsule.1.membrane.command=[]",
                        "flow.command=['sh', 'fluid.sh']", "flow.command.1=other.sh"});
  EXPECT_EQ(the_case.capsules[0].membrane.command, (Texts{"sh", "x y"}));
  EXPECT_EQ(the_case.capsules[1].membrane.command, Texts());
  EXPECT_EQ(the_case.flow.command, (Texts{"sh", "other.sh"}));
  EXPECT_EQ(parse(least_case).capsules[0].membrane.command, Texts());
}

TEST(CaseSet, BareWordsAreTexts) {
  for (const std::string value : {"neo-hookean", "\"neo-hookean\"", "'neo-hookean'", " neo-hookean "}) {
    EXPECT_EQ(parse(least_case, {"membrane.elastic_law=" + value}).capsules[0].membrane.elastic_law,
              "neo-hookean");
  }
  // Also those that would be something else in TOML.
  EXPECT_EQ(parse(least_case, {"title=true"}).title, "true");
  EXPECT_EQ(parse(least_case, {"title=2.5"}).title, "2.5");
  EXPECT_EQ(parse(least_case, {"title=a = b"}).title, "a = b");
  EXPECT_EQ(parse(least_case, {"title="}).title, "");
}

TEST(CaseSet, WholeTables) {
  const auto the_case = parse(least_case, {"capsule.0.mesh={level = 1}", "run={shear_time = 2}"});
  EXPECT_EQ(the_case.capsules[0].mesh.level, 1);
  EXPECT_EQ(the_case.run.shear_time, 2.0);
}

TEST(CaseSet, TablesThatTheFileDoesNotHave) {
  EXPECT_EQ(parse(least_case, {"coupler.kernel=roma3"}).coupler.kernel, "roma3");
  EXPECT_EQ(parse(least_case, {"capsule.0.membrane.area_ratio=2"}).capsules[0].membrane.area_ratio, 2.0);
}

TEST(CaseSet, TheLastOneHolds) {
  EXPECT_EQ(parse(least_case, {"run.shear_time=1", "run.shear_time=2"}).run.shear_time, 2.0);
}

TEST(CaseSet, UnknownKeysAreRefusedAsInAFile) {
  EXPECT_EQ(refusal(least_case, {"flow.reynolds_nmber=1"}),
            "--set flow.reynolds_nmber=1: unknown key; did you mean flow.reynolds_number?");
  EXPECT_THAT(refusal(least_case, {"capsule.0.raduis=1"}), HasSubstr("did you mean capsule.0.radius?"));
  EXPECT_THAT(refusal(least_case, {"flwo.box=[4, 4, 4]"}), HasSubstr("did you mean flow?"));
}

TEST(CaseSet, AnotherLawOverAnEcho) {
  // The echo spells out area_ratio and capillary_modulus of the Skalak membrane that it was.
  const auto skalak = parse(least_case);
  const auto other = parse(to_toml(skalak), {"membrane.elastic_law=neo-hookean"});
  EXPECT_EQ(other.capsules[0].membrane.elastic_law, "neo-hookean");
  EXPECT_EQ(parameters(other).capsules[0].shear_modulus, parameters(skalak).capsules[0].shear_modulus);
  // What is set by hand still contradicts, and so does what is no default.
  EXPECT_THAT(refusal(to_toml(skalak), {"membrane.elastic_law=neo-hookean", "membrane.area_ratio=1"}),
              HasSubstr("contradicts elastic_law"));
  EXPECT_THAT(
      refusal(to_toml(parse(least_case, {"membrane.area_ratio=3"})), {"membrane.elastic_law=neo-hookean"}),
      HasSubstr("membrane.area_ratio = 3.0: contradicts elastic_law"));
}

TEST(CaseSet, AKeyOfAnotherTableForgivesNothing) {
  auto file = least_case;
  file.insert(file.find("[[capsule]]"), "collision = \"bgk\"\nmagic_parameter = 0.1875\n");
  EXPECT_THAT(refusal(file, {"run.threads=1"}), HasSubstr("contradicts collision = \"bgk\""));
}

TEST(CaseSet, WhatEveryCapsuleOverridesIsRefused) {
  EXPECT_THAT(refusal(least_case, {"capsule.0.membrane.area_ratio=2", "membrane.area_ratio=3"}),
              HasSubstr("--set membrane.area_ratio=3: has no effect, for every capsule has its own; set "
                        "capsule.0.membrane.area_ratio"));
  EXPECT_EQ(parse(full_case, {"membrane.capillary_number=0.7"}).capsules[1].membrane.capillary_number, 0.7);
}

TEST(CaseSet, WhatCannotBeSet) {
  EXPECT_THAT(refusal(least_case, {"flow.box"}), HasSubstr("--set flow.box: write key=value"));
  EXPECT_THAT(refusal(least_case, {"=3"}), HasSubstr("write key=value"));
  EXPECT_THAT(refusal(least_case, {"capsule.1.radius=8"}), HasSubstr("there is 1 capsule, number 0"));
  EXPECT_THAT(refusal(full_case, {"capsule.2.radius=8"}), HasSubstr("there are 2 capsules, 0 to 1"));
  EXPECT_THAT(refusal(full_case, {"capsule.N.radius=8"}), HasSubstr("there are 2 capsules, 0 to 1"));
  EXPECT_THAT(refusal(least_case, {"flow.box.3=8"}), HasSubstr("flow.box has the elements 0 to 2"));
  EXPECT_THAT(refusal(least_case, {"output.fluid_box.0=[1, 2]"}),
              HasSubstr("output.fluid_box is not in the file; set it whole, to three pairs of integers"));
  EXPECT_THAT(refusal(least_case, {"flow.reynolds_number.x=8"}),
              HasSubstr("is a single value, it has no 'x'"));
  EXPECT_THAT(refusal(least_case, {"flow.box=[1, 2"}), HasSubstr("not valid TOML"));
  EXPECT_THAT(refusal(least_case, {"title=\"open"}), HasSubstr("not valid TOML"));
  // A word that is not UTF-8 would make an echo that is no TOML.
  EXPECT_THAT(refusal(least_case, {"title=\xff"}), HasSubstr("not valid TOML"));
  EXPECT_THAT(refusal("[flow]\nbox = [9, 9, 9]\n", {"capsule.0.radius=3"}), HasSubstr("write [[capsule]]"));
  EXPECT_NE(refusal(least_case, {"flow.box=[36, 40, 44]\ntitle = \"smuggled\""}), "");
}

}  // namespace
