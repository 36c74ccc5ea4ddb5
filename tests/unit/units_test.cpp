// Units, both ways, against numbers worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driver/units.hpp"

namespace tanktread::driver {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The case of the thesis's Chapter 2: L = 120, a = L/(2 pi), tau = 1, U0 = 4e-3.
Case thesis_case() {
  Case c;
  c.flow.box = {120, 120, 120};
  c.flow.wall_speed = 4e-3;
  c.flow.collision = "bgk";
  CapsuleCase capsule;
  capsule.radius = 60.0 / std::numbers::pi;
  capsule.position = {60, 60, 60};
  c.capsules = {capsule};
  return c;
}

// A few operations of rounding 1.1e-16 each.
constexpr double rounding = 1e-15;

TEST(Units, ThesisCase) {
  const auto p = parameters(thesis_case());
  EXPECT_NEAR(p.kinematic_viscosity, 1.0 / 6.0, rounding);
  EXPECT_EQ(p.relaxation_time_odd, 1.0);
  EXPECT_NEAR(p.shear_rate, 8e-3 / 120, rounding);
  EXPECT_NEAR(p.steps_per_shear_time, 15000, 15000 * rounding);
  EXPECT_NEAR(p.reynolds_number, 0.146, 5e-4);  // as method.md rounds it
  EXPECT_NEAR(p.mach_number, 4e-3 * std::sqrt(3.0), rounding);
  const auto& capsule = p.capsules[0];
  EXPECT_NEAR(capsule.capillary_by_E_s, 0.3, rounding);
  EXPECT_NEAR(capsule.capillary_by_G_s, 0.6, rounding);  // G_s = E_s/2
  EXPECT_NEAR(capsule.skalak_modulus, p.kinematic_viscosity * p.shear_rate * capsule.radius / 0.3, rounding);
  EXPECT_NEAR(capsule.area_modulus, 3 * capsule.shear_modulus, rounding);  // K_s = G_s (1 + 2C), C = 1
}

TEST(Units, ReynoldsNumberAndWallSpeedAreTwoWaysToSayOneThing) {
  auto by_speed = thesis_case();
  auto by_reynolds = by_speed;
  by_reynolds.flow.wall_speed.reset();
  by_reynolds.flow.reynolds_number = parameters(by_speed).reynolds_number;
  EXPECT_NEAR(parameters(by_reynolds).wall_speed, 4e-3, 4e-3 * 4 * rounding);
}

TEST(Units, PoiseuilleForceGivesTheCentreSpeed) {
  auto c = thesis_case();
  c.flow.kind = "poiseuille";
  const auto p = parameters(c);
  // F L^2/(8 nu) is the centre speed of plane Poiseuille flow.
  EXPECT_NEAR(p.body_force[0] * 120 * 120 / (8 * p.kinematic_viscosity), 4e-3, 4e-3 * 4 * rounding);
}

TEST(Units, TwoRelaxationTimes) {
  auto c = thesis_case();
  c.flow.collision = "trt";
  c.flow.relaxation_time = 0.8;
  EXPECT_NEAR(parameters(c).relaxation_time_odd, 0.5 + 0.1875 / 0.3, rounding);
}

TEST(Units, DropletHasGammaOnly) {
  auto c = thesis_case();
  c.capsules[0].membrane.elastic_law = "interfacial-tension";
  c.capsules[0].membrane.capillary_modulus = "gamma";
  const auto capsule = parameters(c).capsules[0];
  EXPECT_GT(capsule.interfacial_tension, 0);
  EXPECT_NEAR(capsule.capillary_by_gamma, 0.3, rounding);
  EXPECT_EQ(capsule.shear_modulus, 0);
  EXPECT_EQ(capsule.capillary_by_G_s, 0);
}

TEST(Units, SiScalesTurnLatticeModuliBackIntoTheGivenOnes) {
  auto c = thesis_case();
  c.flow.wall_speed.reset();
  c.flow.reynolds_number = 0.05;
  c.si = SiCase{4e-6, 100.0, 1.2e-3, 1000.0, 5.3e-6, std::nullopt};
  c.capsules[0].membrane.capillary_modulus = "G_s";
  c.capsules[0].membrane.capillary_number = 1.2e-3 * 100.0 * 4e-6 / 5.3e-6;
  const auto p = parameters(c);
  const auto si = si_scales(c, p);
  ASSERT_TRUE(si.has_value());
  EXPECT_NEAR(p.capsules[0].shear_modulus * si->force_N / si->length_m, 5.3e-6, 5.3e-6 * 20 * rounding);
  EXPECT_NEAR(p.shear_rate / si->time_s, 100.0, 100.0 * 4 * rounding);
  EXPECT_NEAR(p.capsules[0].radius * si->length_m, 4e-6, 4e-6 * 4 * rounding);
  EXPECT_NEAR(si->reynolds_number_physical, 1000 * 100 * 16e-12 / 1.2e-3, 1e-15);
  EXPECT_FALSE(si_scales(thesis_case(), p).has_value());
}

TEST(Warnings, NoneForTheThesisCaseAndOneForEachFault) {
  auto c = thesis_case();
  EXPECT_THAT(warnings(c, parameters(c), {1.3}), IsEmpty());
  EXPECT_THAT(warnings(c, parameters(c), {2.5})[0], HasSubstr("mesh edge"));
  c.flow.wall_speed = 0.1;
  EXPECT_THAT(warnings(c, parameters(c), {1.3})[0], HasSubstr("Mach number"));
  c.flow.wall_speed = 4e-3;
  c.flow.relaxation_time = 0.52;
  EXPECT_THAT(warnings(c, parameters(c), {1.3})[0], HasSubstr("tau+"));
  c.flow.relaxation_time = 1;
  c.capsules[0].radius = 45;
  EXPECT_THAT(warnings(c, parameters(c), {1.3})[0], HasSubstr("periodic image along x"));
}

TEST(Echo, NamesWhatFollows) {
  const auto c = thesis_case();
  const auto text = echo(c, parameters(c), {100.0, 60.0, 1e9, 1e8}, {"beware"});
  for (const char* word : {"120 x 120 x 120", "wall speed", "relaxation time tau-", "Mach number",
                           "Reynolds number", "Ca by E_s", "Ca by G_s", "steps a shear time", "15000",
                           "1.00 GB", "1 min 00 s", "100.0 MLUPS", "warning: beware"}) {
    EXPECT_THAT(text, HasSubstr(word));
  }
}

}  // namespace
}  // namespace tanktread::driver
