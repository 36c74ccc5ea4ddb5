// From dimensionless numbers to lattice units. The expected values are worked out here from the definitions
// of docs/units.md, by another way than the library's where there is one.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/units/units.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;

/// Each of these numbers takes fewer than twenty products and quotients, each rounded by at most eps/2.
constexpr double rounding = 20 * 0.5 * 2.3e-16;

void expect_near(double value, double expected) {
  EXPECT_NEAR(value, expected, rounding * std::abs(expected));
}

TEST(UnitsParameters, TheThesisAtHalfResolution) {
  // Chapter 2 halved: L = 60, a = L/(2 pi), tau+ = 1, Re = 0.146. nu = 1/6; g = Re nu/a^2; U0 = g L/2.
  const auto p = parameters(parse(least_case, {"flow.box=[60, 60, 60]", "capsule.0.position=[30, 30, 30]",
                                               "capsule.0.radius=9.549", "flow.reynolds_number=0.146"}));
  expect_near(p.kinematic_viscosity, 1.0 / 6.0);
  expect_near(p.reynolds_number, 0.146);
  expect_near(p.shear_rate * 9.549 * 9.549 * 6.0, 0.146);
  expect_near(p.wall_speed, 30.0 * p.shear_rate);
  expect_near(p.steps_per_shear_time * p.shear_rate, 1.0);
  expect_near(p.mach_number * p.mach_number, 3.0 * p.wall_speed * p.wall_speed);
  // At Re = 0.146 and L = 120 the thesis has U0 = 4e-3, so 8e-3 at L = 60 (its
  // radius is rounded to four digits, its Re to three).
  EXPECT_NEAR(p.wall_speed, 8e-3, 8e-3 * 2e-3);
  // Ca = 0.3 by E_s: E_s = nu g a/0.3, and E_s = 2 G_s, K_s = G_s (1 + 2 C) with C = 1.
  const auto& c = p.capsules.at(0);
  expect_near(c.skalak_modulus * 0.3, p.shear_rate * 9.549 / 6.0);
  expect_near(c.shear_modulus, 0.5 * c.skalak_modulus);
  expect_near(c.area_modulus, 3.0 * c.shear_modulus);
  expect_near(c.capillary_by_E_s, 0.3);
  expect_near(c.capillary_by_G_s, 0.6);
  EXPECT_EQ(c.capillary_by_gamma, 0.0);
  EXPECT_EQ(c.interfacial_tension, 0.0);
}

TEST(UnitsParameters, SpeedLimitByTheWalls) {
  const auto limit = [](const std::string& text, const std::vector<std::string>& keys) {
    return parameters(parse(text, keys)).speed_limit;
  };
  const std::string by_wall_speed = "flow={box=[36, 40, 44], wall_speed=1e-3}";
  EXPECT_EQ(limit(least_case, {by_wall_speed}), 5 * 1e-3);
  EXPECT_EQ(limit(least_case, {by_wall_speed, "flow.wall_speed=0.07"}), 0.3);
  EXPECT_EQ(limit(least_case, {by_wall_speed, "flow.body_force=[0.0, 1e-6, 0.0]"}), 0.3);
  EXPECT_EQ(limit(least_case, {by_wall_speed, "flow.speed_limit=0.1"}), 0.1);
  EXPECT_EQ(limit(droplet_case, {}), 0.3);  // periodic: no walls
}

TEST(UnitsParameters, CapillaryNumberByEachModulus) {
  const auto by_G_s = parameters(parse(least_case, {"membrane.capillary_modulus=G_s"})).capsules[0];
  expect_near(by_G_s.capillary_by_G_s, 0.3);
  expect_near(by_G_s.capillary_by_E_s, 0.15);
  const auto neo = parameters(parse(least_case, {"membrane.elastic_law=neo-hookean"})).capsules[0];
  expect_near(neo.capillary_by_G_s, 0.3);
  expect_near(neo.area_modulus, 3.0 * neo.shear_modulus);
  EXPECT_EQ(neo.capillary_by_E_s, 0.0);  // E_s is a word of Skalak's law
  EXPECT_EQ(neo.skalak_modulus, 0.0);
  const auto hookean =
      parameters(parse(least_case, {"membrane.elastic_law=hookean", "membrane.poisson_ratio=0.2"}))
          .capsules[0];
  expect_near(hookean.area_modulus, 1.2 / 0.8 * hookean.shear_modulus);
  const auto area = parameters(parse(least_case, {"membrane.area_ratio=10"})).capsules[0];
  expect_near(area.area_modulus, 21.0 * area.shear_modulus);
}

// Energies are in units of the modulus of the law, G_s or gamma, and of the radius of each capsule: here 6.
TEST(UnitsParameters, EnergiesByTheModulusOfTheLaw) {
  const std::vector<std::string> energies = {
      "membrane.bending_modulus=0.01", "membrane.spontaneous_curvature=-3",
      "membrane.global_area_modulus=100", "membrane.local_area_modulus=20", "membrane.volume_modulus=50"};
  for (const std::string law : {"skalak", "neo-hookean", "interfacial-tension"}) {
    auto keys = energies;
    keys.push_back("membrane.elastic_law=" + law);
    const auto c = parameters(parse(least_case, keys)).capsules[0];
    const double modulus = law == "interfacial-tension" ? c.interfacial_tension : c.shear_modulus;
    EXPECT_GT(modulus, 0) << law;
    expect_near(c.energy.bending_modulus, 0.01 * modulus * 36);
    expect_near(c.energy.spontaneous_curvature, -0.5);
    expect_near(c.energy.global_area_modulus, 100 * modulus);
    expect_near(c.energy.local_area_modulus, 20 * modulus);
    expect_near(c.energy.volume_modulus, 50 * modulus / 6);
    EXPECT_EQ(c.capillary_by_kappa_b, 0.0);
  }
  EXPECT_FALSE(parameters(parse(least_case)).capsules[0].energy.any());
}

// Ca = mu_o g a^3/kappa_b = 0.3, and G = kappa_b/a^2.
TEST(UnitsParameters, WithoutALawTheModulusIsThatOfBending) {
  const auto p =
      parameters(parse(least_case, {"membrane.elastic_law=none", "membrane.local_area_modulus=1000"}));
  const auto& c = p.capsules[0];
  expect_near(c.energy.bending_modulus, p.kinematic_viscosity * p.shear_rate * 216 / 0.3);
  expect_near(c.energy.local_area_modulus, 1000 * c.energy.bending_modulus / 36);
  expect_near(c.capillary_by_kappa_b, 0.3);
  for (const double none : {c.shear_modulus, c.area_modulus, c.interfacial_tension, c.capillary_by_G_s,
                            c.capillary_by_gamma, c.capillary_by_E_s})
    EXPECT_EQ(none, 0.0);
}

TEST(UnitsParameters, EachCapsuleHasItsOwnRadius) {
  const auto p = parameters(parse(full_case));
  const double nu = 0.1, g = p.shear_rate;  // tau+ = 0.8
  expect_near(p.capsules[0].skalak_modulus, nu * g * 5.1 / 0.1);
  expect_near(p.capsules[1].shear_modulus, nu * g * 7.0 / 0.1);
  // The Reynolds number is that of the first.
  expect_near(p.reynolds_number, g * 5.1 * 5.1 / nu);
}

TEST(UnitsParameters, Poiseuille) {
  // Walls across y (50 high), flow along z. The steady profile of a force F between walls L apart,
  // u = F (L/2)^2/(2 nu) in the middle, must be U0 there.
  const auto p = parameters(parse(full_case));
  expect_near(p.wall_speed, 0.0123456789012345678);
  expect_near(p.shear_rate, 2.0 * p.wall_speed / 50.0);
  const double driving = p.body_force[2] + 2e-9;  // less the force of the key
  // The force of the key is taken off again, which loses eps times the total: well within the bound, for it
  // is smaller by three orders.
  expect_near(driving * 25.0 * 25.0 / (2.0 * p.kinematic_viscosity), p.wall_speed);
  EXPECT_EQ(p.body_force[0], 1e-7);
  EXPECT_EQ(p.body_force[1], 0.0);
}

TEST(UnitsParameters, Shear) {
  const auto p = parameters(parse(least_case));
  EXPECT_EQ(p.body_force, (std::array<double, 3>{0, 0, 0}));
  // By the wall speed: the same flow.
  auto text = least_case;
  const std::string key = "reynolds_number = 0.1";
  text.replace(text.find(key), key.size(), "");
  const auto q = parameters(parse(text, {"flow.wall_speed=" + std::to_string(0.01)}));
  EXPECT_EQ(q.wall_speed, 0.01);
  expect_near(q.shear_rate, 0.02 / 44.0);
  expect_near(q.reynolds_number, 0.02 / 44.0 * 36.0 * 6.0);
}

TEST(UnitsParameters, Periodic) {
  const auto p = parameters(parse(droplet_case));
  EXPECT_EQ(p.shear_rate, 1e-4);
  EXPECT_EQ(p.wall_speed, 0.0);
  expect_near(p.reynolds_number, 1e-4 * 36.0 * 6.0);
  expect_near(p.mach_number, 6e-4 * std::sqrt(3.0));
  const auto& c = p.capsules[0];
  expect_near(c.interfacial_tension, 1e-4 * 6.0 / 6.0 / 0.2);
  expect_near(c.capillary_by_gamma, 0.2);
  EXPECT_EQ(c.shear_modulus, 0.0);
  EXPECT_EQ(c.capillary_by_G_s, 0.0);
  EXPECT_EQ(c.area_modulus, 0.0);
}

TEST(UnitsParameters, RelaxationTimes) {
  const auto trt = parameters(parse(full_case));
  expect_near((trt.relaxation_time - 0.5) * (trt.relaxation_time_odd - 0.5), 0.25);
  const auto bgk = parameters(parse(droplet_case));
  EXPECT_EQ(bgk.relaxation_time_odd, bgk.relaxation_time);
}

TEST(UnitsParameters, NoMembraneViscosityWithoutASchemeOrABoussinesqNumber) {
  EXPECT_FALSE(parameters(parse(least_case)).capsules[0].viscous);
  EXPECT_FALSE(
      parameters(parse(least_case, {"membrane.viscous={boussinesq_shear = 10}"})).capsules[0].viscous);
  EXPECT_FALSE(parameters(parse(least_case, {"membrane.viscous={scheme = \"fd\", spring_stiffness = 100}"}))
                   .capsules[0]
                   .viscous);
}

TEST(UnitsParameters, MembraneViscosityAndTheThreeFormsOfItsSpring) {
  // least_case: a = 6, nu = 1/6, L = 44, g = 0.1 nu/a^2, U0 = g L/2.
  const auto viscous = [](const std::string& keys) {
    const auto p = parameters(parse(least_case, {"membrane.viscous={scheme = \"int2\", interval = 4, "
                                                 "boussinesq_shear = 10, boussinesq_dilatational = 5, " +
                                                 keys + "}"}));
    return std::pair(p, p.capsules[0].viscous.value());
  };
  const auto [p, by_stiffness] = viscous("spring_stiffness = 100");
  EXPECT_EQ(by_stiffness.scheme, "int2");
  EXPECT_EQ(by_stiffness.interval, 4);
  expect_near(by_stiffness.shear_viscosity, 10.0);  // Bq_s nu a = 10 * 6/6
  expect_near(by_stiffness.dilatational_viscosity, 5.0);
  // kappa = L k'/(U0 mu_s) (Sect. 3.4.3); the dilatational spring relaxes as fast as that of the shear.
  expect_near(44.0 * by_stiffness.shear_spring / (p.wall_speed * 10.0), 100.0);
  expect_near(by_stiffness.dilatational_spring / 5.0, by_stiffness.shear_spring / 10.0);

  const auto [q, by_time] =
      viscous("spring_relaxation_time = 0.05, spring_relaxation_time_dilatational = 0.1");
  expect_near(10.0 / by_time.shear_spring * q.shear_rate, 0.05);  // tau g
  expect_near(5.0 / by_time.dilatational_spring * q.shear_rate, 0.1);

  const auto [r, by_modulus] = viscous("spring_modulus = 0.3, spring_modulus_dilatational = 0.2");
  expect_near(by_modulus.shear_spring, 0.3);
  expect_near(by_modulus.dilatational_spring, 0.2);

  const auto [t, by_both] = viscous("spring_modulus = 0.3, spring_stiffness_dilatational = 50");
  expect_near(44.0 * by_both.dilatational_spring / (t.wall_speed * 5.0), 50.0);
}

TEST(UnitsParameters, SamplingAndMeasureGoIntoTheLaw) {
  using namespace tanktread::membrane;
  const std::string keys = "membrane.viscous={scheme = \"fd\", boussinesq_shear = 1, spring_stiffness = 100";
  const auto preset = parameters(parse(least_case, {keys + "}"})).capsules[0].viscous.value();
  EXPECT_EQ(preset.sampling, StrainSampling::latest);
  EXPECT_EQ(preset.measure, StressMeasure::rate_of_deformation);
  const auto other = parameters(parse(least_case, {keys + ", strain_sampling = \"moving-average\", "
                                                          "stress_measure = \"rate-of-strain\"}"}))
                         .capsules[0]
                         .viscous.value();
  EXPECT_EQ(other.sampling, StrainSampling::moving_average);
  EXPECT_EQ(other.measure, StressMeasure::rate_of_strain);
}

}  // namespace
