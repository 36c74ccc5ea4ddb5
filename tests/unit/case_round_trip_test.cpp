// The echo of a case is a case: read back it equals the case, to the last bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "driver/case/schema.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;
using ::testing::Not;

void expect_round_trip(const Case& the_case) {
  const auto toml = to_toml(the_case);
  const auto name = the_case.file.filename().string();
  const auto again = parse_case(toml, name, the_case.file.parent_path());
  EXPECT_TRUE(again == the_case) << toml;
  EXPECT_EQ(to_toml(again), toml);
}

TEST(CaseRoundTrip, EveryKindOfCase) {
  for (const auto& text : {least_case, full_case, droplet_case, si_case}) expect_round_trip(parse(text));
}

TEST(CaseRoundTrip, WithAssignments) {
  const std::vector<std::vector<std::string>> all = {
      {"flow.kind=poiseuille", "flow.wall_axis=x", "flow.flow_axis=y", "capsule.0.position.2=3"},
      {"flow.collision=bgk"},
      {"flow.storage=single"},
      {"membrane.elastic_law=neo-hookean"},
      {"membrane.elastic_law=hookean", "membrane.poisson_ratio=-0.25"},
      {"membrane.elastic_law=interfacial-tension"},
      {"membrane.capillary_modulus=G_s", "membrane.area_ratio=0"},
      {"output.fluid_box=[[0, 0], [3, 7], [0, 43]]", "output.observables_every=0"},
      {"output.energy_every=0.3", "output.measures_every=0.1"},
      {"membrane.viscous={boussinesq_shear = 10, spring_stiffness = 100, interval = 20}"},
      {"membrane.viscous={strain_sampling = \"moving-average\", stress_measure = \"rate-of-strain\"}"},
      {"membrane.viscous={spring_relaxation_time = 0.01, spring_modulus_dilatational = 2e-3}"},
      {"membrane.command=[\"/bin/sh\", \"a \\\"b\\\"\", \"\"]", "run.command_time_limit=0.5"},
      {"flow.command=[\"sh\"]", "run.command_directory=packets"},
      {"flow.viscosity_ratio=5", "capsule.0.viscosity_ratio=0.2"},
      {"capsule.0.mesh={shape = \"biconcave\", level = 4, direction = [0.1, -2, 1e-3]}"},
      {"capsule.0.mesh={shape = \"spheroid\", aspect_ratio = 0.3, euler_angles = [10, -20, 400]}"},
      {"capsule.0.mesh={shape = \"spheroid\", reduced_volume = 0.65}",
       "capsule.0.stress_free={shape = \"spheroid\", reduced_volume = 0.95}"},
      {"capsule.0.stress_free={shape = \"spheroid\", aspect_ratio = 2}"},
      {"capsule.0.stress_free.shape=sphere"},
      {"membrane.bending_modulus=0.01", "membrane.spontaneous_curvature=-2", "membrane.reference_volume=0.6"},
      {"membrane.elastic_law=none", "membrane.local_area_modulus=100", "membrane.global_area_modulus=1e3",
       "membrane.volume_modulus=7", "membrane.reference_area=1.01"},
  };
  for (const auto& assignments : all) expect_round_trip(parse(least_case, assignments));
}

TEST(CaseRoundTrip, WithPhysicalValues) {
  const std::vector<std::vector<std::string>> all = {
      {"flow.reynolds_number=0.1"},
      {"flow.wall_speed=0.01"},
      {"flow.kind=periodic", "flow.shear_rate=1e-4"},
      {"si.membrane_shear_viscosity_N_s_per_m=3e-7", "si.membrane_dilatational_viscosity_N_s_per_m=1e-7"},
      {"si.density_kg_per_m3=997.0479"},
      {"si.inner_viscosity_Pa_s=6.1e-3"},
      {"flow.viscosity_ratio=5", "capsule.1.viscosity_ratio=0.7"},
      {"si.bending_modulus_J=2e-19", "si.spontaneous_curvature_per_m=-1e5",
       "si.global_area_modulus_N_per_m=1e-3", "si.local_area_modulus_N_per_m=1e-4",
       "si.volume_modulus_N_per_m2=50", "membrane.reference_area=1.01"},
  };
  for (const auto& assignments : all) expect_round_trip(parse(si_case, assignments));
  auto droplet = si_case;
  const std::string modulus = "shear_modulus_N_per_m";
  droplet.replace(droplet.find(modulus), modulus.size(), "interfacial_tension_N_per_m");
  expect_round_trip(parse(droplet, {"membrane.elastic_law=interfacial-tension"}));
  auto vesicle = si_case;
  vesicle.erase(vesicle.find(modulus));  // the last line
  expect_round_trip(parse(vesicle, {"membrane.elastic_law=none", "si.bending_modulus_J=2e-19"}));
}

TEST(CaseRoundTrip, WithAMeshFile) {
  const auto folder = std::filesystem::temp_directory_path() / "tanktread-round-trip-test \"quoted\"";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cell.vtu") << "only its presence is looked at";
  expect_round_trip(parse_case(least_case, "case.toml", folder, {"capsule.0.mesh.file=cell.vtu"}));
  expect_round_trip(
      parse_case(least_case, "case.toml", folder,
                 {"capsule.0.mesh.file=cell.vtu", "capsule.0.stress_free.file=cell.vtu",
                  "capsule.0.stress_free.file_hash=0123456789abcdef", "capsule.0.mesh.direction=[1, 0, 0]"}));
  std::filesystem::remove_all(folder);
}

TEST(CaseRoundTrip, EveryDoubleSurvives) {
  for (const double value : {1.0 / 3.0, 0.1, 1e-300, 5e-324, 1e22, 1.7976931348623157e308, 123456789.0,
                             std::nextafter(1.0, 2.0)}) {
    auto the_case = parse(least_case);
    the_case.run.shear_time = value;
    EXPECT_EQ(parse(to_toml(the_case)).run.shear_time, value);
  }
}

TEST(CaseRoundTrip, EveryTextSurvives) {
  for (const std::string title :
       {"", "a \"quote\"", "back\\slash", "two\nlines\r\n", "tab\t", "\x01\x7f", "'", "µ # ="}) {
    auto the_case = parse(least_case);
    the_case.title = title;
    EXPECT_EQ(parse(to_toml(the_case)).title, title);
  }
}

TEST(CaseRoundTrip, EveryKeyThatHasAPlaceIsWritten) {
  const auto toml = to_toml(parse(full_case));
  for (const auto* key : {"wall_axis", "inertia", "speed_limit", "mesh.level", "viscosity_ratio",
                          "\nviscous.scheme", "membrane.poisson_ratio", "checkpoint_every", "fluid_box"}) {
    EXPECT_THAT(toml, HasSubstr(std::string(key) + " = "));
  }
  // What all capsules share stands in [membrane] alone, so that it can be changed there.
  EXPECT_THAT(toml, Not(HasSubstr("membrane.viscous.scheme")));
  EXPECT_THAT(toml, Not(HasSubstr("\n[si]")));
  EXPECT_THAT(toml, Not(HasSubstr("\nreynolds_number")));
}

TEST(CaseRoundTrip, CasesDifferWhereOneKeyDiffers) {
  // So that the equality above means something.
  const auto the_case = parse(full_case);
  for (const auto& key : schema()) {
    auto other = the_case;
    const auto value = key.get(the_case, 1);
    if (key.kind == Kind::real && key.path.find("si.") != 0) key.set(other, 1, 0.777);
    if (key.kind == Kind::integer) key.set(other, 1, 77);
    if (key.kind == Kind::text)
      key.set(other, 1, key.choices.empty() ? std::string("x") : key.choices.front());
    EXPECT_EQ(other == the_case, key.get(other, 1) == value) << key.path;
  }
}

TEST(CaseOverrides, ACapsulesOwnTableOverridesKeyByKey) {
  const auto the_case = parse(full_case);
  ASSERT_EQ(the_case.capsules.size(), 2u);
  const auto &first = the_case.capsules[0].membrane, &second = the_case.capsules[1].membrane;
  EXPECT_EQ(first.elastic_law, "skalak");
  EXPECT_EQ(first.area_ratio, 10.5);
  EXPECT_EQ(first.capillary_modulus, "E_s");
  EXPECT_EQ(second.elastic_law, "hookean");
  EXPECT_EQ(second.poisson_ratio, 0.3);
  EXPECT_EQ(second.capillary_number, 0.1);                  // from [membrane]
  EXPECT_EQ(second.area_ratio, MembraneCase().area_ratio);  // a Hookean membrane has none: not inherited
  EXPECT_EQ(second.capillary_modulus, "G_s");
}

TEST(CaseOverrides, TheModulusFollowsTheLaw) {
  const std::pair<const char*, const char*> all[] = {{"skalak", "E_s"},
                                                     {"neo-hookean", "G_s"},
                                                     {"hookean", "G_s"},
                                                     {"interfacial-tension", "gamma"},
                                                     {"none", "kappa_b"}};
  for (const auto& [law, modulus] : all) {
    EXPECT_EQ(parse(least_case, {std::string("membrane.elastic_law=") + law})
                  .capsules[0]
                  .membrane.capillary_modulus,
              modulus);
  }
}

}  // namespace
