// SI values to the numbers of a case, to the lattice, and back.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/units/si.hpp"
#include "tests/unit/case_samples.hpp"

namespace tanktread::testing::units_si_test {
namespace {

using namespace tanktread::driver;

/// Fewer than fifty products and quotients there and back, each rounded by at most eps/2.
constexpr double rounding = 50 * 0.5 * 2.3e-16;

void expect_near(double value, double expected) {
  EXPECT_NEAR(value, expected, rounding * std::abs(expected));
}

void expect_near(const std::optional<double>& value, const std::optional<double>& expected) {
  ASSERT_EQ(value.has_value(), expected.has_value());
  if (value) expect_near(*value, *expected);
}

SiCase there_and_back(const Case& the_case) {
  const auto p = parameters(the_case);
  return si_of(the_case, p, si_scales(the_case, p).value());
}

void expect_same_but_density(const SiCase& a, const SiCase& b) {
  expect_near(a.radius_m, b.radius_m);
  expect_near(a.shear_rate_per_s, b.shear_rate_per_s);
  expect_near(a.viscosity_Pa_s, b.viscosity_Pa_s);
  expect_near(a.shear_modulus_N_per_m, b.shear_modulus_N_per_m);
  expect_near(a.interfacial_tension_N_per_m, b.interfacial_tension_N_per_m);
  expect_near(a.membrane_shear_viscosity_N_s_per_m, b.membrane_shear_viscosity_N_s_per_m);
  expect_near(a.membrane_dilatational_viscosity_N_s_per_m, b.membrane_dilatational_viscosity_N_s_per_m);
  expect_near(a.bending_modulus_J, b.bending_modulus_J);
  expect_near(a.spontaneous_curvature_per_m, b.spontaneous_curvature_per_m);
  expect_near(a.global_area_modulus_N_per_m, b.global_area_modulus_N_per_m);
  expect_near(a.local_area_modulus_N_per_m, b.local_area_modulus_N_per_m);
  expect_near(a.volume_modulus_N_per_m2, b.volume_modulus_N_per_m2);
}

TEST(UnitsSi, DimensionlessNumbers) {
  const auto the_case = parse(si_case, {"si.membrane_shear_viscosity_N_s_per_m=4.8e-8",
                                        "si.membrane_dilatational_viscosity_N_s_per_m=2.4e-8"});
  // Ca = mu g a/G_s = 1.2e-3 * 1000 * 4e-6/5.3e-6; Re = rho g a^2/mu = 1050 * 1000 * 16e-12/1.2e-3 = 0.014;
  // Bq_s = 4.8e-8/(1.2e-3 * 4e-6) = 10.
  const auto &first = the_case.capsules[0].membrane, &second = the_case.capsules[1].membrane;
  EXPECT_EQ(first.capillary_modulus, "G_s");
  expect_near(first.capillary_number, 4.8 / 5.3);
  expect_near(*the_case.flow.reynolds_number, 0.014);
  expect_near(first.viscous.boussinesq_shear, 10.0);
  expect_near(first.viscous.boussinesq_dilatational, 5.0);
  // The second capsule is half as large: half of Ca, twice Bq.
  expect_near(second.capillary_number, 2.4 / 5.3);
  expect_near(second.viscous.boussinesq_shear, 20.0);
  // One material: both have the same modulus on the lattice.
  const auto p = parameters(the_case);
  expect_near(p.capsules[1].shear_modulus, p.capsules[0].shear_modulus);
}

TEST(UnitsSi, Scales) {
  const auto the_case = parse(si_case);
  const auto p = parameters(the_case);
  const auto scales = si_scales(the_case, p).value();
  expect_near(scales.length_m, 5e-7);  // 4e-6 m over 8 steps
  expect_near(1000.0 * scales.time_s, p.shear_rate);
  expect_near(scales.reynolds_number_physical, 0.014);
  // Where the physical Re is run, the force by viscosity is the force by density: rho length^4/time^2.
  expect_near(scales.force_N, 1050.0 * std::pow(scales.length_m, 4) / (scales.time_s * scales.time_s));
  EXPECT_FALSE(si_scales(parse(least_case), parameters(parse(least_case))).has_value());
}

TEST(UnitsSi, ThereAndBack) {
  const auto the_case = parse(si_case, {"si.membrane_shear_viscosity_N_s_per_m=3e-7"});
  const auto back = there_and_back(the_case);
  expect_same_but_density(back, *the_case.si);
  expect_near(back.density_kg_per_m3, 1050.0);
}

TEST(UnitsSi, TheInnerViscosity) {
  const auto the_case = parse(si_case, {"si.inner_viscosity_Pa_s=6e-3"});
  for (const auto& capsule : the_case.capsules) expect_near(capsule.viscosity_ratio, 5.0);
  EXPECT_EQ(the_case.flow.viscosity_ratio, 1.0);
  expect_near(there_and_back(the_case).inner_viscosity_Pa_s, 6e-3);
  EXPECT_FALSE(there_and_back(parse(si_case)).inner_viscosity_Pa_s.has_value());
  EXPECT_FALSE(has_contrast(parse(si_case, {"si.inner_viscosity_Pa_s=1.2e-3"})));
}

TEST(UnitsSi, AnotherReynoldsNumberIsAnotherDensityAndNothingElse) {
  for (const std::string key : {"flow.reynolds_number=0.14", "flow.wall_speed=0.01"}) {
    const auto the_case = parse(si_case, {key});
    const auto back = there_and_back(the_case);
    expect_same_but_density(back, *the_case.si);
    expect_near(back.density_kg_per_m3, 1050.0 * parameters(the_case).reynolds_number / 0.014);
  }
}

TEST(UnitsSi, OfADroplet) {
  auto text = si_case;
  const std::string modulus = "shear_modulus_N_per_m = 5.3e-6";
  text.replace(text.find(modulus), modulus.size(), "interfacial_tension_N_per_m = 2e-5");
  const auto the_case = parse(text, {"membrane.elastic_law=interfacial-tension"});
  EXPECT_EQ(the_case.capsules[0].membrane.capillary_modulus, "gamma");
  expect_near(the_case.capsules[0].membrane.capillary_number, 4.8e-6 / 2e-5);
  expect_same_but_density(there_and_back(the_case), *the_case.si);
}

const std::vector<std::string> si_energies = {
    "si.bending_modulus_J=2.12e-19", "si.spontaneous_curvature_per_m=-5e5",
    "si.global_area_modulus_N_per_m=5.3e-4", "si.local_area_modulus_N_per_m=5.3e-5",
    "si.volume_modulus_N_per_m2=132.5"};

// G_s = 5.3e-6 N/m, a = 4e-6 m: kappa_b/(G_s a^2) = 2.12e-19/(5.3e-6 * 16e-12) = 0.0025, c_0 a = -2,
// k_A/G_s = 100, k_d/G_s = 10, k_V a/G_s = 100. The second capsule is half as large.
TEST(UnitsSi, Energies) {
  const auto the_case = parse(si_case, si_energies);
  const auto &first = the_case.capsules[0].membrane.energy, &second = the_case.capsules[1].membrane.energy;
  expect_near(first.bending_modulus, 0.0025);
  expect_near(first.spontaneous_curvature, -2.0);
  expect_near(first.global_area_modulus, 100.0);
  expect_near(first.local_area_modulus, 10.0);
  expect_near(first.volume_modulus, 100.0);
  expect_near(second.bending_modulus, 0.01);
  expect_near(second.spontaneous_curvature, -1.0);
  expect_near(second.volume_modulus, 50.0);
  expect_same_but_density(there_and_back(the_case), *the_case.si);
  const auto p = parameters(the_case);
  expect_near(p.capsules[1].energy.bending_modulus, p.capsules[0].energy.bending_modulus);
}

// Ca = mu g a^3/kappa_b = 1.2e-3 * 1000 * 64e-18/2.12e-19, and G = kappa_b/a^2 = 1.325e-8 N/m.
TEST(UnitsSi, WithoutALaw) {
  auto text = si_case;
  text.erase(text.find("shear_modulus_N_per_m"));
  auto keys = si_energies;
  keys.push_back("membrane.elastic_law=none");
  const auto the_case = parse(text, keys);
  const auto &first = the_case.capsules[0].membrane, &second = the_case.capsules[1].membrane;
  EXPECT_EQ(first.capillary_modulus, "kappa_b");
  expect_near(first.capillary_number, 7.68e-17 / 2.12e-19);
  expect_near(second.capillary_number, 0.96e-17 / 2.12e-19);
  EXPECT_EQ(first.energy.bending_modulus, 0.0);
  expect_near(first.energy.global_area_modulus, 5.3e-4 / 1.325e-8);
  expect_same_but_density(there_and_back(the_case), *the_case.si);
  const auto p = parameters(the_case);
  expect_near(p.capsules[1].energy.bending_modulus, p.capsules[0].energy.bending_modulus);
  expect_near(p.capsules[1].energy.global_area_modulus, p.capsules[0].energy.global_area_modulus);
}

TEST(UnitsSi, OfAPeriodicBox) {
  const auto the_case = parse(si_case, {"flow.kind=periodic", "flow.shear_rate=1e-4"});
  EXPECT_FALSE(the_case.flow.reynolds_number.has_value());
  expect_same_but_density(there_and_back(the_case), *the_case.si);
}

TEST(UnitsSi, TheSameCaseInBothForms) {
  // Re and Ca of the SI values, put in by hand, give the same lattice values.
  auto text = si_case.substr(0, si_case.find("[si]"));
  text += "[membrane]\ncapillary_modulus = \"G_s\"\ncapillary_number = 0.3\n";
  const auto p = parameters(parse(si_case));
  const auto q = parameters(
      parse(text, {"flow.reynolds_number=0.014", "capsule.0.membrane.capillary_number=0.90566037735849056604",
                   "capsule.1.membrane.capillary_number=0.45283018867924528302"}));
  expect_near(p.wall_speed, q.wall_speed);
  for (int k = 0; k < 2; ++k) expect_near(p.capsules[k].shear_modulus, q.capsules[k].shear_modulus);
}

}  // namespace
}  // namespace tanktread::testing::units_si_test
