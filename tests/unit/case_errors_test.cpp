// Bad input: each message names file and line, key, value, what is allowed and the fix.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// least_case with a line put before line `before` (1 is the first).
std::string with_line(int before, const std::string& line) {
  std::string text = least_case;
  std::size_t at = 0;
  for (int k = 1; k < before; ++k) at = text.find('\n', at) + 1;
  return text.insert(at, line + "\n");
}

/// least_case with one line replaced.
std::string with_changed(const std::string& old_line, const std::string& new_line) {
  std::string text = least_case;
  return text.replace(text.find(old_line), old_line.size(), new_line);
}

TEST(CaseDefaults, AreThoseOfTheStructs) {
  const auto c = parse(least_case);
  EXPECT_TRUE(c.coupler == CouplerCase());
  EXPECT_TRUE(c.run == RunCase());
  EXPECT_TRUE(c.output == OutputCase());
  EXPECT_TRUE(c.capsules[0].mesh == MeshCase());
  EXPECT_EQ(c.flow.magic_parameter, 0.1875);
  EXPECT_EQ(c.flow.relaxation_time, 1.0);
  EXPECT_EQ(c.flow.wall_axis, 2);
}

TEST(CaseErrors, TheLeastCaseIsFine) {
  EXPECT_EQ(refusal(least_case), "");
  EXPECT_EQ(refusal(full_case), "");
  EXPECT_EQ(refusal(droplet_case), "");
  EXPECT_EQ(refusal(si_case), "");
}

struct Bad {
  std::string key_and_value;         ///< an assignment over least_case
  std::vector<std::string> message;  ///< pieces the message must have
};

TEST(CaseErrors, ValuesOfTheWrongTypeOrRange) {
  const std::vector<Bad> all = {
      {"flow.relaxation_time=0.5", {"a number > 0.5 (default 1.0)"}},
      {"flow.relaxation_time=nan", {"is not finite", "a number > 0.5"}},
      {"flow.relaxation_time=inf", {"is not finite"}},
      {"flow.relaxation_time=\"fast\"", {"a number > 0.5"}},
      {"flow.reynolds_number=0", {"a number > 0"}},
      {"flow.reynolds_number=-1e-3", {"a number > 0"}},
      {"flow.box=[36, 40]", {"three integers >= 4"}},
      {"flow.box=[36, 40, 44, 48]", {"three integers >= 4"}},
      {"flow.box=[36, 40, 44.0]", {"three integers >= 4"}},
      {"flow.box=[36, 40, 3]", {"three integers >= 4"}},
      {"flow.box=[36, 40, 99999999999]", {"three integers >= 4"}},
      {"flow.box=36", {"three integers >= 4"}},
      {"flow.kind=\"sheer\"", {"\"poiseuille\"", "did you mean \"shear\"?", "(default \"shear\")"}},
      {"flow.kind=3", {"one of \"shear\""}},
      {"flow.wall_axis=\"w\"", {"one of \"x\", \"y\", \"z\""}},
      {"flow.inertia=1", {"true or false"}},
      {"flow.body_force=[0, 0, nan]", {"three numbers"}},
      {"flow.speed_limit=0.0", {"a number > 0"}},
      {"flow.magic_parameter=0", {"a number > 0"}},
      {"capsule.0.radius=0", {"a number > 0"}},
      {"capsule.0.position=[1, 2]", {"three numbers"}},
      {"capsule.0.mesh.level=9", {"an integer >= 0 and <= 8"}},
      {"capsule.0.mesh.level=2.0", {"an integer >= 0 and <= 8"}},
      {"capsule.0.mesh.shape=\"cube\"", {"\"sphere\""}},
      {"membrane.elastic_law=\"skalack\"", {"\"interfacial-tension\"", "did you mean \"skalak\"?"}},
      {"membrane.capillary_number=0.0", {"a number > 0"}},
      {"membrane.capillary_modulus=\"Es\"", {"\"gamma\"", "did you mean \"E_s\"?"}},
      {"membrane.area_ratio=-0.1", {"a number >= 0"}},
      {"membrane.poisson_ratio=1.0", {"a number > -1 and < 1"}},
      {"membrane.viscous.scheme=\"fd1\"", {"did you mean \"fd\"?"}},
      {"membrane.viscous.interval=0", {"an integer >= 1"}},
      {"membrane.viscous.boussinesq_shear=-1", {"a number >= 0"}},
      {"membrane.viscous.strain_sampling=\"mean\"", {"\"moving-average\""}},
      {"membrane.viscous.stress_measure=\"rate-of-stress\"", {"did you mean \"rate-of-strain\"?"}},
      {"membrane.command=\"sh\"", {"a list of texts (default [])"}},
      {"membrane.command=[\"sh\", 1]", {"a list of texts"}},
      {"run.command_time_limit=0", {"a number > 0"}},
      {"coupler.kernel=\"peskin\"", {"\"roma3\"", "did you mean \"peskin4\"?"}},
      {"run.shear_time=-1", {"a number >= 0"}},
      {"run.threads=-1", {"an integer >= 0"}},
      {"run.checkpoint_every=0", {"a number > 0"}},
      {"output.fluid_every=-0.5", {"a number >= 0"}},
      {"output.fluid_box=[[0, 1], [0, 1]]", {"three pairs of integers"}},
      {"output.fluid_box=[[0, 1], [0, 1], [0, 1, 2]]", {"three pairs of integers"}},
  };
  for (const auto& bad : all) {
    const auto message = refusal(least_case, {bad.key_and_value});
    EXPECT_THAT(message, StartsWith("--set " + bad.key_and_value + ": ")) << bad.key_and_value;
    for (const auto& piece : bad.message) EXPECT_THAT(message, HasSubstr(piece));
  }
}

TEST(CaseErrors, FileLineKeyAndValueAreNamed) {
  EXPECT_EQ(refusal(with_line(3, "relaxation_time = 0.4")),
            "case.toml:3: flow.relaxation_time = 0.4: must be a number > 0.5 (default 1.0)");
  EXPECT_EQ(
      refusal(with_line(6, "viscosity_ratoi = 1")),
      "case.toml:6: capsule.0.viscosity_ratoi = 1: unknown key; did you mean capsule.0.viscosity_ratio?");
}

TEST(CaseErrors, UnknownKeys) {
  EXPECT_THAT(refusal(with_line(2, "reynolds_nmber = 1")), HasSubstr("did you mean flow.reynolds_number?"));
  EXPECT_THAT(refusal(with_line(2, "kernel = \"roma3\"")), HasSubstr("did you mean coupler.kernel?"));
  EXPECT_THAT(refusal(with_line(2, "colour_of_the_sky = 3")), HasSubstr("unknown key; remove it"));
  EXPECT_THAT(refusal(least_case + "[ouput]\nfluid_every = 1\n"),
              HasSubstr("case.toml:9: ouput: unknown key; did you mean output?"));
  EXPECT_THAT(refusal(with_line(1, "\"flow.box\" = [4, 4, 4]")), HasSubstr("must not be quoted"));
  EXPECT_THAT(refusal(with_line(9, "[membrane.viscous]\nkappa = 1")),
              HasSubstr("membrane.viscous.kappa = 1: unknown key"));
}

TEST(CaseErrors, TablesAndLists) {
  EXPECT_THAT(refusal("[capsule]\nradius = 3\n" + least_case.substr(0, least_case.find("[[capsule"))),
              HasSubstr("write [[capsule]]"));
  EXPECT_THAT(refusal(with_line(6, "mesh = \"sphere\"")), HasSubstr("must be a table; write mesh = { ... }"));
  EXPECT_THAT(refusal("flow = 3\n"), HasSubstr("flow = 3: must be a table"));
  EXPECT_THAT(refusal("[flow\n"), StartsWith("case.toml:1: not valid TOML: "));
  EXPECT_THAT(refusal(with_line(7, "position = [1, 2, 3]")), HasSubstr("not valid TOML"));  // twice
}

TEST(CaseErrors, MissingKeys) {
  EXPECT_THAT(
      refusal(with_changed("radius = 6.0\n", "")),
      AllOf(StartsWith("case.toml:4: "), HasSubstr("capsule.0.radius: is missing; give a number > 0")));
  EXPECT_THAT(refusal(with_changed("position = [18.0, 20.0, 22.0]\n", "")),
              HasSubstr("capsule.0.position: is missing; give three numbers"));
  EXPECT_THAT(refusal(with_changed("box = [36, 40, 44]\n", "")), HasSubstr("flow.box: is missing"));
  EXPECT_THAT(refusal(with_changed("reynolds_number = 0.1\n", "")),
              HasSubstr("flow.reynolds_number: is missing; give reynolds_number or wall_speed"));
  EXPECT_THAT(refusal(with_changed("capillary_number = 0.3\n", "")),
              HasSubstr("capsule.0.membrane.capillary_number: is missing"));
  EXPECT_THAT(refusal(least_case.substr(0, least_case.find("[[capsule"))),
              HasSubstr("capsule: is missing; give at least one [[capsule]]"));
  EXPECT_THAT(refusal("capsule = []\n[flow]\nbox = [9, 9, 9]\nwall_speed = 0.1\n"),
              HasSubstr("capsule: is missing; give at least one [[capsule]]"));
  EXPECT_THAT(refusal(droplet_case, {"flow.box=[32, 32, 32]", "flow.kind=shear"}),
              HasSubstr("flow.reynolds_number: is missing"));
  for (const std::string key : {"radius_m", "shear_rate_per_s", "viscosity_Pa_s"}) {
    auto text = si_case;
    const auto at = text.find(key + " ");
    text.erase(at, text.find('\n', at) - at);
    EXPECT_THAT(refusal(text), HasSubstr("si." + key + ": is missing; give a number > 0"));
  }
}

TEST(CaseErrors, AKeyGivenWronglyIsNotCalledMissing) {
  EXPECT_THAT(refusal(least_case, {"capsule.0.radius=big"}), Not(HasSubstr("missing")));
  EXPECT_THAT(refusal(least_case, {"flow.reynolds_number=0"}), Not(HasSubstr("missing")));
}

struct Contradiction {
  std::string text;
  std::vector<std::string> assignments;
  std::string message;
};

TEST(CaseErrors, Contradictions) {
  auto vesicle_in_si = si_case + "[membrane]\nelastic_law = \"none\"\n";
  vesicle_in_si.erase(vesicle_in_si.find("shear_modulus_N_per_m"),
                      std::string("shear_modulus_N_per_m = 5.3e-6\n").size());
  const std::vector<Contradiction> all = {
      {least_case, {"flow.wall_speed=0.01"}, "contradicts flow.reynolds_number"},
      {least_case, {"flow.shear_rate=1e-4"}, "for kind = \"periodic\" only"},
      {least_case, {"flow.collision=bgk", "flow.magic_parameter=0.25"}, "contradicts collision = \"bgk\""},
      {least_case, {"flow.flow_axis=z"}, "--set flow.flow_axis=z: is the wall axis too (z)"},
      {least_case, {"membrane.capillary_modulus=gamma"}, "contradicts elastic_law = \"skalak\""},
      {least_case,
       {"membrane.poisson_ratio=0.3"},
       "contradicts elastic_law = \"skalak\", which has none (it is of hookean)"},
      {least_case,
       {"membrane.elastic_law=neo-hookean", "membrane.area_ratio=1"},
       "contradicts elastic_law = \"neo-hookean\", which has none (it is of skalak)"},
      {least_case, {"membrane.elastic_law=hookean", "membrane.capillary_modulus=gamma"}, "give \"G_s\""},
      {droplet_case, {"membrane.capillary_modulus=G_s"}, "give \"gamma\""},
      {droplet_case, {"flow.start=developed"}, "no developed profile"},
      {droplet_case, {"flow.wall_speed=0.1"}, "give flow.shear_rate instead"},
      {droplet_case, {"flow.reynolds_number=0.1"}, "give flow.shear_rate instead"},
      {si_case, {"membrane.capillary_number=0.3"}, "--set membrane.capillary_number=0.3: contradicts [si]"},
      {si_case, {"capsule.1.membrane.capillary_number=0.3"}, "contradicts [si]"},
      {si_case, {"membrane.capillary_modulus=G_s"}, "contradicts [si]"},
      {si_case, {"membrane.viscous.boussinesq_shear=1"}, "contradicts [si]"},
      {si_case, {"si.interfacial_tension_N_per_m=1e-6"}, "exactly one of shear_modulus_N_per_m"},
      {si_case,
       {"membrane.elastic_law=interfacial-tension"},
       "give interfacial_tension_N_per_m in its place"},
      {least_case,
       {"membrane.elastic_law=none", "membrane.bending_modulus=1"},
       "membrane.bending_modulus=1: contradicts elastic_law = \"none\", whose capillary_number is of "
       "kappa_b"},
      {least_case,
       {"membrane.elastic_law=none", "membrane.capillary_modulus=G_s"},
       "contradicts elastic_law = \"none\" of capsule 0, which has none; give \"kappa_b\""},
      {least_case, {"membrane.capillary_modulus=kappa_b"}, "give \"E_s\""},
      {least_case, {"membrane.bending_modulus=-1"}, "membrane.bending_modulus=-1: must be a number >= 0"},
      {least_case, {"membrane.reference_volume=0"}, "membrane.reference_volume=0: must be a number > 0"},
      {least_case,
       {"membrane.command=[\"sh\"]", "membrane.volume_modulus=1"},
       "membrane.volume_modulus=1: contradicts membrane.command of capsule 0: the program gives all forces"},
      {least_case,
       {"membrane.command=[\"sh\"]", "membrane.elastic_law=none"},
       "membrane.elastic_law=none: contradicts membrane.command of capsule 0"},
      {si_case,
       {"capsule.1.membrane.command=[\"sh\"]", "si.bending_modulus_J=2e-19"},
       "si.bending_modulus_J=2e-19: contradicts membrane.command of capsule 1"},
      {si_case, {"membrane.global_area_modulus=1"}, "membrane.global_area_modulus=1: contradicts [si]"},
      {si_case,
       {"membrane.elastic_law=none", "si.bending_modulus_J=2e-19"},
       "si.shear_modulus_N_per_m = 5.3e-06: contradicts elastic_law = \"none\", which has none; remove it"},
      {vesicle_in_si, {}, "si.bending_modulus_J: is missing; elastic_law = \"none\" needs it as its modulus"},
      {vesicle_in_si,
       {"si.bending_modulus_J=0"},
       "si.bending_modulus_J=0: is 0; elastic_law = \"none\" needs"},
      {si_case,
       {"capsule.1.membrane.elastic_law=none"},
       "capsule.1.membrane.elastic_law=none: is \"none\" in capsule 1, beside capsules with a law"},
      {least_case, {"capsule.0.mesh.file=none.vtu"}, "there is no file /somewhere/none.vtu"},
      {least_case, {"capsule.0.mesh.file="}, "is empty"},
      {least_case, {"capsule.0.stress_free.file=none.vtu"}, "there is no file /somewhere/none.vtu"},
      {least_case,
       {"capsule.0.mesh.shape=spheroid"},
       "--set capsule.0.mesh.shape=spheroid: needs aspect_ratio or reduced_volume beside it"},
      {least_case,
       {"capsule.0.stress_free.shape=spheroid"},
       "--set capsule.0.stress_free.shape=spheroid: needs aspect_ratio or reduced_volume beside it"},
      {least_case,
       {"capsule.0.mesh={shape = \"spheroid\", aspect_ratio = 2, reduced_volume = 0.9}"},
       "contradicts aspect_ratio, from which it follows; remove one of them"},
      {least_case,
       {"capsule.0.mesh.aspect_ratio=2"},
       "contradicts shape = \"sphere\"; it is of \"spheroid\" only"},
      {least_case,
       {"capsule.0.stress_free.reduced_volume=0.9"},
       "contradicts shape = \"mesh\"; it is of \"spheroid\" only"},
      {least_case,
       {"capsule.0.mesh={shape = \"spheroid\", aspect_ratio = 20}"},
       "must be a number >= 0.1 and <= 10"},
      {least_case,
       {"capsule.0.mesh.direction=[0, 0, 0]"},
       "--set capsule.0.mesh.direction=[0, 0, 0]: has no length, so it points nowhere"},
      {least_case,
       {"capsule.0.mesh={direction = [1, 0, 0], euler_angles = [0, 90, 0]}"},
       "contradicts mesh.direction; remove one of them"},
      {least_case, {"flow.viscosity_ratio=0"}, "flow.viscosity_ratio=0: must be a number > 0"},
      {least_case, {"capsule.0.viscosity_ratio=-1"}, "capsule.0.viscosity_ratio=-1: must be a number > 0"},
      {si_case,
       {"si.inner_viscosity_Pa_s=6e-3", "flow.viscosity_ratio=5"},
       "--set flow.viscosity_ratio=5: contradicts si.inner_viscosity_Pa_s"},
      {si_case,
       {"si.inner_viscosity_Pa_s=6e-3", "capsule.1.viscosity_ratio=5"},
       "--set capsule.1.viscosity_ratio=5: contradicts si.inner_viscosity_Pa_s"},
      {si_case, {"si.inner_viscosity_Pa_s=0"}, "si.inner_viscosity_Pa_s=0: must be a number > 0"},
      {least_case,
       {"membrane.viscous={spring_stiffness = 1, spring_modulus = 2}"},
       "at most one of spring_stiffness, spring_relaxation_time, spring_modulus (2 given)"},
      {least_case,
       {"membrane.viscous={spring_stiffness_dilatational = 1, spring_modulus_dilatational = 2}"},
       "at most one of spring_stiffness_dilatational"},
  };
  for (const auto& bad : all) {
    EXPECT_THAT(refusal(bad.text, bad.assignments), HasSubstr(bad.message)) << bad.assignments.front();
    EXPECT_THAT(refusal(bad.text, bad.assignments), Not(HasSubstr("\n"))) << "one problem, not several";
  }
}

TEST(CaseErrors, AViscousSchemeNeedsOneSpringAndTheDilatationARelaxationTime) {
  const std::string dilatational = "membrane.viscous={scheme = \"fd\", boussinesq_dilatational = 5, ";
  for (const std::string scheme : {"fd", "int1", "int2"}) {
    EXPECT_EQ(refusal(least_case, {"membrane.viscous.scheme=" + scheme}),
              "--set membrane.viscous.scheme=" + scheme +
                  ": give exactly one of spring_stiffness, spring_relaxation_time, spring_modulus (0 given)");
    EXPECT_EQ(
        refusal(least_case, {"membrane.viscous.scheme=" + scheme, "membrane.viscous.spring_stiffness=100"}),
        "");
  }
  EXPECT_THAT(refusal(least_case, {dilatational + "spring_modulus = 0.1}"}),
              HasSubstr("give spring_modulus_dilatational, or spring_relaxation_time"));
  EXPECT_EQ(refusal(least_case, {dilatational + "spring_modulus = 0.1, spring_modulus_dilatational = 0.1}"}),
            "");
  EXPECT_EQ(refusal(least_case, {dilatational + "spring_relaxation_time = 0.1}"}), "");
}

TEST(CaseErrors, KeysOfTheSharedMembraneAreForWhomTheyFit) {
  // full_case gives area_ratio in [membrane] to a Skalak and, overridden, a Hookean capsule: fine. Not so a
  // ratio in the Hookean capsule's own table, or one that fits none.
  EXPECT_THAT(refusal(full_case, {"capsule.1.membrane.area_ratio=1"}),
              HasSubstr("--set capsule.1.membrane.area_ratio=1: contradicts elastic_law = \"hookean\""));
  EXPECT_THAT(refusal(full_case, {"capsule.0.membrane.elastic_law=neo-hookean",
                                  "capsule.0.membrane.capillary_modulus=G_s"}),
              HasSubstr("membrane.area_ratio = 10.5: contradicts"));
  // The capsule that inherits a modulus it does not have is named.
  EXPECT_THAT(
      refusal(full_case, {"capsule.0.membrane.elastic_law=interfacial-tension"}),
      HasSubstr("membrane.capillary_modulus = \"E_s\": contradicts elastic_law = \"interfacial-tension\" of "
                "capsule 0"));
}

TEST(CaseErrors, AllProblemsAreSaidTogether) {
  const auto message = refusal(with_line(3, "relaxation_time = 0.4\ncollison = \"trt\""),
                               {"run.threads=-1", "flow.flow_axis=z"});
  EXPECT_THAT(message, StartsWith("case.toml: 4 problems\n  "));
  EXPECT_THAT(message,
              AllOf(HasSubstr("case.toml:3: flow.relaxation_time"), HasSubstr("case.toml:4: flow.collison"),
                    HasSubstr("--set run.threads=-1"), HasSubstr("--set flow.flow_axis=z")));
}

TEST(CaseErrors, FilesThatCannotBeRead) {
  EXPECT_THROW(
      {
        try {
          read_case("/nowhere/case.toml");
        } catch (const InputError& error) {
          EXPECT_THAT(error.what(),
                      AllOf(StartsWith("/nowhere/case.toml: "), HasSubstr("no such case file")));
          throw;
        }
      },
      InputError);
  EXPECT_THROW(read_case("/"), InputError);
}

TEST(CaseErrors, MeshFilesAreTakenFromTheCaseFilesFolder) {
  const auto folder = std::filesystem::temp_directory_path() / "tanktread-case-errors-test";
  std::filesystem::create_directories(folder / "meshes");
  std::ofstream(folder / "meshes/cell.vtu") << "only its presence is looked at";
  std::ofstream(folder / "case.toml") << least_case;
  const auto the_case = read_case(folder / "case.toml", {"capsule.0.mesh.file=meshes/../meshes/cell.vtu"});
  EXPECT_EQ(the_case.capsules[0].mesh.file, (folder / "meshes/cell.vtu").string());
  // The echo may lie anywhere: its path is absolute.
  EXPECT_EQ(parse(to_toml(the_case)).capsules[0].mesh, the_case.capsules[0].mesh);
  try {
    read_case(folder / "case.toml", {"capsule.0.mesh={level = 3, file = \"meshes/cell.vtu\"}"});
    ADD_FAILURE() << "a level beside a file was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("capsule.0.mesh.level = 3: contradicts the file beside it; remove one of them"));
  }
  const std::string mesh = "capsule.0.mesh.file=meshes/cell.vtu";
  EXPECT_EQ(read_case(folder / "case.toml", {mesh, "capsule.0.stress_free.file=meshes/cell.vtu"})
                .capsules[0]
                .stress_free.file,
            (folder / "meshes/cell.vtu").string());
  try {
    read_case(folder / "case.toml", {mesh, "capsule.0.stress_free.shape=sphere"});
    ADD_FAILURE() << "a stress-free shape of other triangles was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has not the triangles of mesh.file, only those of mesh.shape; give "
                                        "stress_free.file"));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
