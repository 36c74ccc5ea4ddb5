// Warnings: each comes on its side of its bound, and not on the other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/plan/warnings.hpp"
#include "driver/plan/warnings_si.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// 2000 steps a shear time: g = 2 U0/L = 5e-4, so every default interval is a whole number of steps; Re =
/// 0.108.
const std::string quiet_case = R"([flow]
box = [40, 40, 40]
wall_speed = 0.01
[[capsule]]
radius = 6
position = [20, 20, 20]
[membrane]
capillary_number = 0.3
)";

std::vector<std::string> warnings_of(const std::vector<std::string>& assignments,
                                     const std::vector<double>& mean_edges = {}) {
  const auto the_case = parse(quiet_case, assignments);
  return warnings(the_case, parameters(the_case), mean_edges,
                  Placement(the_case, membrane_shapes(the_case).meshes));
}

TEST(CaseWarnings, NoneWithoutReason) {
  EXPECT_THAT(warnings_of({}, {1.0}), IsEmpty());
}

struct Warned {
  std::vector<std::string> fine, warned;
  std::string message, key;
};

TEST(CaseWarnings, OneOnEachSideOfItsBound) {
  // Mach = U0 sqrt(3) = 0.1 at U0 = 0.0577; Re = 2 U0/40 * 36/nu, with nu = 1/6 + (tau+ - 1)/3.
  const std::vector<Warned> all = {
      {{"flow.wall_speed=0.0577"}, {"flow.wall_speed=0.0578"}, "Mach number 0.1", "flow.wall_speed"},
      {{"flow.relaxation_time=0.55"}, {"flow.relaxation_time=0.549"}, "below 0.55", "flow.relaxation_time"},
      {{"flow.relaxation_time=2"}, {"flow.relaxation_time=2.01"}, "over 2", "flow.relaxation_time"},
      {{"flow.speed_limit=0.011"}, {"flow.speed_limit=0.01"}, "speed limit", "flow.speed_limit"},
      {{"capsule.0.position.2=12"},
       {"capsule.0.position.2=11.9"},
       "0.983 radii from the wall along z",
       "flow.box"},
      {{"flow.box.0=20", "capsule.0.position.0=9"},
       {"flow.box.0=17", "capsule.0.position.0=9"},
       "0.833 radii from its periodic image along x",
       "flow.box"},
      {{"run.shear_time=0.001"}, {"run.shear_time=0.0002"}, "nothing will be run", "run.shear_time"},
  };
  for (const auto& warned : all) {
    for (const auto& line : warnings_of(warned.fine))
      EXPECT_EQ(line.find(warned.message), std::string::npos) << line;
    EXPECT_THAT(warnings_of(warned.warned),
                Contains(AllOf(HasSubstr(warned.message), HasSubstr(warned.key))));
  }
}

TEST(CaseWarnings, TheRelaxationTimeInACapsule) {
  // nu = 1/6: tau+ = 1/2 + lambda/2 is 0.55 at lambda = 0.1, and 2 at 3.
  for (const std::string fine : {"0.1001", "0.5", "1", "2.999"})
    EXPECT_THAT(warnings_of({"capsule.0.viscosity_ratio=" + fine}), IsEmpty());
  EXPECT_THAT(warnings_of({"flow.viscosity_ratio=0.099"}),
              ElementsAre(AllOf(HasSubstr("tau+ = 0.5495 in capsule 0 is below 0.55"),
                                HasSubstr("raise flow.relaxation_time"))));
  EXPECT_THAT(warnings_of({"flow.viscosity_ratio=3.002"}),
              ElementsAre(AllOf(HasSubstr("tau+ = 2.001 in capsule 0 is over 2"),
                                HasSubstr("lower flow.relaxation_time"))));
}

TEST(CaseWarnings, ReynoldsNumberMattersWithInertia) {
  // Re = 5e-4 * 36/nu = 1 at nu = 0.018, tau+ = 0.554.
  EXPECT_THAT(warnings_of({"flow.relaxation_time=0.5541"}), IsEmpty());
  EXPECT_THAT(warnings_of({"flow.relaxation_time=0.5539"}),
              ElementsAre(AllOf(HasSubstr("Reynolds number 1"), HasSubstr("flow.inertia"))));
  EXPECT_THAT(warnings_of({"flow.relaxation_time=0.5539", "flow.inertia=false"}), IsEmpty());
}

TEST(CaseWarnings, MeshEdges) {
  EXPECT_THAT(warnings_of({}, {0.5}), IsEmpty());
  EXPECT_THAT(warnings_of({}, {2.0}), IsEmpty());
  EXPECT_THAT(warnings_of({}, {0.49}),
              ElementsAre(AllOf(HasSubstr("0.49"), HasSubstr("lower capsule.0.mesh.level"))));
  EXPECT_THAT(warnings_of({}, {2.01}),
              ElementsAre(AllOf(HasSubstr("2.01"), HasSubstr("raise capsule.0.mesh.level"))));
}

// Edges of one grid step on a radius of 6 are those of 16 pi/sqrt(3) 36 = 1045 triangles: with Ca = 0.3 the
// share 6.4/(0.3 * 1045) = 0.0204 a shear time.
TEST(CaseWarnings, ADropWhoseMeshIsShearedForLong) {
  const auto of = [](const std::string& law, double shear_time, double edge) {
    return warnings_of({"membrane.elastic_law=" + law, "run.shear_time=" + std::to_string(shear_time)},
                       {edge});
  };
  const auto said = HasSubstr("D may be off by");
  EXPECT_THAT(of("interfacial-tension", 0.9, 1.0), Not(Contains(said)));
  EXPECT_THAT(of("interfacial-tension", 1.1, 1.0), Contains(said));
  EXPECT_THAT(of("interfacial-tension", 1.1, 0.8), Not(Contains(said)));
  EXPECT_THAT(of("skalak", 20, 1.0), Not(Contains(said)));
  const auto the_case = parse(
      "[flow]\nkind = \"periodic\"\nbox = [40, 40, 40]\nshear_rate = 5e-4\n[[capsule]]\nradius = 6\n"
      "position = [20, 20, 20]\n[membrane]\nelastic_law = \"interfacial-tension\"\ncapillary_number = 0.3\n"
      "[run]\nshear_time = 20\n",
      {});
  EXPECT_THAT(
      warnings(the_case, parameters(the_case), {1.0}, Placement(the_case, membrane_shapes(the_case).meshes)),
      Not(Contains(said)));  // nothing shears it
}

TEST(CaseWarnings, Neighbours) {
  const auto with_second = [](const std::string& x) {
    const auto the_case =
        parse(quiet_case + "[[capsule]]\nradius = 6\nposition = [" + x + ", 20, 20]\n", {"flow.box.0=80"});
    return warnings(the_case, parameters(the_case), {},
                    Placement(the_case, membrane_shapes(the_case).meshes));
  };
  EXPECT_THAT(with_second("38"), IsEmpty());  // 6 grid steps apart: the width of stockie6
  EXPECT_THAT(with_second("37.9"),
              ElementsAre(AllOf(HasSubstr("5.9 grid steps apart"), HasSubstr("stockie6"))));
}

TEST(CaseWarnings, IntervalsThatRoundingChanges) {
  EXPECT_THAT(warnings_of({"output.observables_every=0.02"}), IsEmpty());
  EXPECT_THAT(warnings_of({"output.observables_every=0"}), IsEmpty());
  EXPECT_THAT(warnings_of({"output.observables_every=0.0202"}), IsEmpty());  // 40.4 steps: 1 % off
  EXPECT_THAT(warnings_of({"output.observables_every=0.0008"}),
              ElementsAre(AllOf(HasSubstr("output.observables_every = 0.0008"),
                                HasSubstr("1.6 steps, rounded to 2"), HasSubstr("set it to 0.001"))));
  EXPECT_THAT(warnings_of({"output.observables_every=0.0107"}),  // 21.4 steps: 2 % off
              ElementsAre(HasSubstr("rounded to 21")));
  EXPECT_THAT(warnings_of({"output.membrane_every=1e-9"}), ElementsAre(HasSubstr("rounded to 1")));
  EXPECT_THAT(warnings_of({"run.checkpoint_every=0.0012"}), ElementsAre(HasSubstr("run.checkpoint_every")));
}

TEST(CaseWarnings, MembraneViscosityThatIsSwitchedOff) {
  EXPECT_THAT(warnings_of({"membrane.viscous.boussinesq_shear=10"}),
              ElementsAre(AllOf(HasSubstr("capsule 0"), HasSubstr("viscous.scheme = \"none\""))));
}

TEST(CaseWarnings, MembraneViscosityThatIsZero) {
  EXPECT_THAT(warnings_of({"membrane.viscous={scheme = \"fd\", spring_stiffness = 100}"}),
              ElementsAre(AllOf(HasSubstr("capsule 0"), HasSubstr("both Boussinesq numbers are 0"))));
}

TEST(CaseWarnings, AnIntervalLongerThanTheRelaxationTime) {
  // tau = 5 steps by modulus: mu_s = Bq_s mu_o a.
  const auto mu_s = parameters(parse(least_case, {"membrane.viscous={scheme = \"fd\", boussinesq_shear = 1, "
                                                  "spring_stiffness = 100}"}))
                        .capsules[0]
                        .viscous->shear_viscosity;
  const auto with_interval = [&](int interval) {
    return warnings_of({"membrane.viscous={scheme = \"fd\", boussinesq_shear = 1, spring_modulus = " +
                            std::to_string(mu_s / 5) + ", interval = " + std::to_string(interval) + "}",
                        "coupler.tangential_correction=false"});  // which would need a softer spring
  };
  EXPECT_THAT(with_interval(4), IsEmpty());
  EXPECT_THAT(with_interval(6),
              ElementsAre(AllOf(HasSubstr("interval of 6 steps"), HasSubstr("tau_s = 5 "))));
}

TEST(CaseWarnings, ASpringTooStiffForAnExplicitUpdate) {
  // least_case has mu_o = 1/6: with this kernel, without the correction, 32 mu_o = 5.33. With Bq_s = 100
  // (mu_s = 100) no interval here exceeds tau.
  const auto with = [&](const std::string& keys) {
    return warnings_of({"membrane.viscous={scheme = \"fd\", boussinesq_shear = 100, " + keys + "}",
                        "coupler.kernel=cosine4"});
  };
  EXPECT_THAT(with("spring_modulus = 5.3"), IsEmpty());
  EXPECT_THAT(with("spring_modulus = 16.0"),
              ElementsAre(AllOf(HasSubstr("N k_s' = 16 is over 5.33"), HasSubstr("by 3"))));
  EXPECT_THAT(with("spring_modulus = 0.53, interval = 10"), IsEmpty());
  EXPECT_THAT(with("spring_modulus = 0.54, interval = 10"), ElementsAre(HasSubstr("N k_s' = 5.4 is over")));
  EXPECT_THAT(with("spring_modulus = 0.1, boussinesq_dilatational = 100, spring_modulus_dilatational = 8"),
              ElementsAre(AllOf(HasSubstr("N k_d' = 8 is over"), HasSubstr("spring_..._dilatational"))));
}

TEST(CaseWarnings, ASpringTooStiffForTheTangentialCorrection) {
  // 6 mu_o = 1, with the default kernel. Without the correction 16 mu_o = 2.67 would do.
  const auto with = [](const std::string& modulus, const std::vector<std::string>& more = {}) {
    std::vector<std::string> assignments = {
        "membrane.viscous={scheme = \"fd\", boussinesq_shear = 100, spring_modulus = " + modulus + "}"};
    assignments.insert(assignments.end(), more.begin(), more.end());
    return warnings_of(assignments);
  };
  const std::string fix = "set coupler.tangential_correction = false (up to 16 mu_o)";
  EXPECT_THAT(with("0.99"), IsEmpty());
  EXPECT_THAT(with("1.01"), ElementsAre(AllOf(HasSubstr("is over 1 = 6 mu_o"), HasSubstr(fix))));
  EXPECT_THAT(with("2.6"), ElementsAre(HasSubstr(fix)));
  EXPECT_THAT(with("2.6", {"coupler.tangential_correction=false"}), IsEmpty());
  EXPECT_THAT(with("2.7"), ElementsAre(AllOf(HasSubstr("is over 1 = 6 mu_o"), Not(HasSubstr("coupler.")))));
}

TEST(CaseWarnings, CapillaryNumbersThatNoCapsuleHas) {
  for (const std::string fine : {"1e-4", "0.3", "10"})
    EXPECT_THAT(warnings_of({"membrane.capillary_number=" + fine}), IsEmpty());
  EXPECT_THAT(warnings_of({"membrane.capillary_number=0.99e-4"}),
              ElementsAre(AllOf(HasSubstr("Ca = 9.9e-05 is outside 0.0001 to 10"),
                                HasSubstr("hardly deforms"), HasSubstr("check membrane.capillary_number"))));
  EXPECT_THAT(warnings_of({"membrane.capillary_number=452830"}),
              ElementsAre(AllOf(HasSubstr("Ca = 4.528e+05"), HasSubstr("hardly resists"))));
}

std::vector<std::string> si_warnings_of(const std::vector<std::string>& assignments) {
  const auto the_case = parse(si_case, assignments);
  return si_warnings(the_case, parameters(the_case));
}

TEST(CaseWarnings, PhysicalValuesThatAreOffByTheirUnit) {
  EXPECT_THAT(si_warnings_of({}), IsEmpty());
  EXPECT_THAT(si_warnings_of({"si.membrane_shear_viscosity_N_s_per_m=3e-7"}), IsEmpty());
  // Each as it would be in another unit: micrometres, mPa s, g/cm^3, uN/m ... Re is kept, so that it alone
  // warns.
  const std::vector<std::pair<std::string, std::string>> all = {
      {"si.radius_m", "4"},
      {"si.shear_rate_per_s", "1e9"},
      {"si.viscosity_Pa_s", "1.2e6"},
      {"si.inner_viscosity_Pa_s", "6e6"},
      {"si.density_kg_per_m3", "1e-3"},
      {"si.shear_modulus_N_per_m", "5.3e3"},
      {"si.membrane_shear_viscosity_N_s_per_m", "300"},
      {"si.membrane_dilatational_viscosity_N_s_per_m", "1e-20"},
  };
  for (const auto& [key, value] : all) {
    EXPECT_THAT(si_warnings_of({key + "=" + value}),
                Contains(AllOf(HasSubstr(key + " = "), HasSubstr("check its unit"))))
        << key;
  }
}

TEST(CaseWarnings, ADensityFarFromTheOneGiven) {
  // The physical Re is 1050 * 1000 * (4e-6)^2/1.2e-3 = 0.014.
  EXPECT_THAT(si_warnings_of({"flow.reynolds_number=1.39"}), IsEmpty());
  EXPECT_THAT(si_warnings_of({"flow.reynolds_number=1.41"}),
              ElementsAre(AllOf(HasSubstr("density of 1.057e+05 kg/m^3, 100.7 times si.density_kg_per_m3"),
                                HasSubstr("change flow.reynolds_number"))));
  EXPECT_THAT(si_warnings_of({"flow.reynolds_number=1.41e-4"}), IsEmpty());
  EXPECT_THAT(si_warnings_of({"flow.reynolds_number=1.39e-4"}), ElementsAre(HasSubstr("0.009929 times")));
}

}  // namespace
