// The echo: what must be in it, and that it can be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "driver/plan/echo.hpp"
#include "driver/plan/echo_table.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/system/components.hpp"
#include "tests/unit/case_samples.hpp"
#include "tests/unit/echo_lines.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Cost sample_cost() {
  Cost cost;
  cost.memory_bytes = 40e6;
  cost.files = {{"fluid files", 20, 20, 120e6, 2}, {"checkpoints", 10, 2, 100e6, 1}};
  cost.mlups = 20;
  cost.step_seconds = 405;
  return cost;
}

/// Every number as long as it can be.
Cost widest_cost() {
  Cost cost;
  cost.memory_bytes = 123.4e9;
  cost.files = {{"fluid files", 1e6, 1e6, 123.4e6, 0.0959}, {"checkpoints", 1e6, 2, 123.4e9, 0.25}};
  cost.mlups = 123.4;
  cost.step_seconds = 95.99 * 3600;
  return cost;
}

TEST(Echo, SaysWhyAndWhatIsNotMeasured) {
  auto cost = sample_cost();
  for (auto& files : cost.files) files.seconds = 0;
  EXPECT_EQ(line_of(echo_of(parse(least_case), cost), "run time"),
            "run time 6 min 45 s steps 6 min 45 s, writing not measured");
  cost.mlups = 0;
  cost.breakdown = "step 1: too fast";
  EXPECT_EQ(line_of(echo_of(parse(least_case), cost), "run time"),
            "run time not measured the first steps break down: see warning");
}

TEST(Echo, SaysWhatFollows) {
  const auto text = echo_of(parse(least_case, {"flow.box=[60, 60, 60]", "capsule.0.position=[30, 30, 30]",
                                               "capsule.0.radius=9.549", "flow.reynolds_number=0.146"}),
                            sample_cost(), {{.mean_edge = 1.25}});
  // g = 0.146/6/9.549^2 = 2.66861e-4, U0 = 30 g.
  EXPECT_EQ(line_of(text, "box"), "box 60 x 60 x 60 0.216 million nodes");
  EXPECT_EQ(line_of(text, "shear rate g"), "shear rate g 0.000266861 2 U0/L");
  EXPECT_EQ(line_of(text, "wall speed U0"), "wall speed U0 0.00800584 g L/2");
  EXPECT_EQ(line_of(text, "relaxation time tau-"), "relaxation time tau- 0.875 1/2 + Lambda/(tau+ - 1/2)");
  EXPECT_EQ(line_of(text, "Reynolds number Re"), "Reynolds number Re 0.146 g a^2/nu, a of capsule 0");
  EXPECT_EQ(line_of(text, "Mach number"), "Mach number 0.01387 U0 sqrt(3)");
  EXPECT_THAT(line_of(text, "Ca by E_s"), HasSubstr("Ca by E_s 0.3 mu_o g a/E_s"));
  EXPECT_EQ(line_of(text, "Ca by G_s"), "Ca by G_s 0.6 mu_o g a/G_s");
  EXPECT_THAT(line_of(text, "mean mesh edge"), HasSubstr("1.25"));
  EXPECT_EQ(line_of(text, "viscosity ratio lambda"), "viscosity ratio lambda 1 mu_i/mu_o");
  // 1/g = 3747.27 steps; 10 shear times are 37473; every 0.02 is 75 steps: 1 + 499 and the last.
  EXPECT_EQ(line_of(text, "steps a shear time"), "steps a shear time 3747.3 1/g");
  EXPECT_EQ(line_of(text, "steps"), "steps 37473 to shear time 10");
  EXPECT_EQ(line_of(text, "observables"), "observables 501 times, every 75 steps");
  EXPECT_EQ(line_of(text, "memory"), "memory 40.0 MB at its peak");
  EXPECT_EQ(line_of(text, "size of fluid files"), "size of fluid files 2.40 GB 20 of 120.0 MB in 40 s");
  EXPECT_EQ(line_of(text, "size of checkpoints"), "size of checkpoints 200.0 MB 10 of 100.0 MB in 10 s");
  // Three checkpoints while the last is written.
  EXPECT_EQ(line_of(text, "disk"), "disk 2.60 GB with 2 checkpoints; at most 2.70 GB");
  EXPECT_EQ(line_of(text, "run time"), "run time 7 min 35 s steps 6 min 45 s, writing 50 s");
  EXPECT_EQ(line_of(text, "speed"), "speed 20.0 MLUPS measured now, as the time to write");
}

TEST(Echo, SaysWhatAViscosityRatioMakesOfTheFluidInside) {
  const auto text = echo_of(parse(si_case, {"si.inner_viscosity_Pa_s=6e-3", "flow.relaxation_time=0.8"}));
  // nu = 0.1: mu_i = 0.5, tau+ = 1/2 + 3 * 0.5.
  EXPECT_EQ(line_of(text, "viscosity ratio lambda"), "viscosity ratio lambda 5 mu_i/mu_o");
  EXPECT_EQ(line_of(text, "viscosity mu_i"), "viscosity mu_i 0.5 0.006 Pa s lambda mu_o");
  EXPECT_EQ(line_of(text, "tau+ inside"), "tau+ inside 2 1/2 + 3 lambda nu");
  EXPECT_THAT(echo_of(parse(si_case)), AllOf(Not(HasSubstr("mu_i  ")), Not(HasSubstr("tau+ inside"))));
}

TEST(Echo, NamesOnlyWhatTheCaseHas) {
  const auto droplet = echo_of(parse(droplet_case));
  EXPECT_THAT(droplet,
              AllOf(HasSubstr("Ca by gamma"), Not(HasSubstr("G_s")), Not(HasSubstr("wall speed")),
                    Not(HasSubstr("mean mesh edge")), Not(HasSubstr("SI")), HasSubstr("not measured")));
  const auto poiseuille = echo_of(parse(full_case));
  EXPECT_THAT(line_of(poiseuille, "body force z"), HasSubstr("8 nu U0/L^2"));
  EXPECT_THAT(poiseuille, AllOf(HasSubstr("walls across y, body force along z"), HasSubstr("capsule 1"),
                                HasSubstr("no inertia"), HasSubstr("never")));
}

TEST(Echo, MembraneViscosityWithItsSpringInAllForms) {
  // a = 6, mu_o = 1/6, g = 0.1/6/36: mu_s = 10; kappa 100 is k' = 100 g 10/2 and tau g = 2/100.
  const auto text = echo_of(parse(least_case, {"membrane.viscous={scheme = \"int1\", boussinesq_shear = 10, "
                                               "spring_stiffness = 100, interval = 3}",
                                               "coupler.kernel=cosine4"}));
  EXPECT_EQ(line_of(text, "kernel"), "kernel cosine4");
  EXPECT_EQ(line_of(text, "viscous scheme"), "viscous scheme int1 rate-of-deformation");
  EXPECT_EQ(line_of(text, "interval N"), "interval N 3 steps; latest strain");
  EXPECT_EQ(line_of(text, "Bq_s"), "Bq_s 10 mu_s/(mu_o a)");
  EXPECT_EQ(line_of(text, "mu_s"), "mu_s 10 Bq_s mu_o a");
  EXPECT_EQ(line_of(text, "kappa_s"), "kappa_s 100 L k_s'/(U0 mu_s)");
  EXPECT_EQ(line_of(text, "k_s'"), "k_s' 0.231481 kappa_s g mu_s/2");
  EXPECT_EQ(line_of(text, "tau_s g"), "tau_s g 0.02 g mu_s/k_s'");
  EXPECT_THAT(line_of(text, "tau_s"), HasSubstr("tau_s 43.2 mu_s/k_s'"));
  // N k_s' may be 32 mu_o = 5.333: kappa = 2 * 5.333/(3 * 10 g), N = 5.333/0.2315 = 23.04.
  EXPECT_EQ(line_of(text, "N k_s'"), "N k_s' 0.694444 stable up to 5.33 = 32 mu_o");
  EXPECT_EQ(line_of(text, "largest kappa_s"), "largest kappa_s 768 that is stable at N = 3");
  EXPECT_EQ(line_of(text, "largest N"), "largest N 23 that is stable with this k_s'");
  EXPECT_EQ(line_of(text, "Bq_d"), "Bq_d 0");
}

TEST(Echo, SaysThatTheVelocityOfNodesIsCorrected) {
  const auto text = echo_of(parse(
      least_case, {"membrane.viscous={scheme = \"fd\", boussinesq_shear = 10, spring_stiffness = 100}"}));
  EXPECT_EQ(line_of(text, "kernel"), "kernel stockie6 with the tangential correction");
  EXPECT_THAT(line_of(text, "N k_s'"), HasSubstr("stable up to 1 = 6 mu_o"));
}

TEST(Echo, SiColumn) {
  const auto text = echo_of(parse(si_case, {"flow.reynolds_number=0.14"}));
  EXPECT_EQ(line_of(text, "grid step"), "grid step 1 5e-07 m radius_m / radius");
  EXPECT_THAT(line_of(text, "shear rate g"), HasSubstr("1000 1/s"));
  EXPECT_THAT(line_of(text, "wall speed U0"), HasSubstr("0.015 m/s"));  // 1000/s * 30 * 5e-7 m
  EXPECT_THAT(line_of(text, "viscosity mu_o = nu"), HasSubstr("0.0012 Pa s"));
  EXPECT_THAT(line_of(text, "G_s"), HasSubstr("5.3e-06 N/m"));
  EXPECT_THAT(line_of(text, "E_s"), HasSubstr("1.06e-05 N/m"));
  EXPECT_THAT(line_of(text, "radius a"), HasSubstr("4e-06 m"));
  EXPECT_EQ(line_of(text, "physical Re"), "physical Re 0.014 the run has 10 times that");
  EXPECT_EQ(line_of(text, "density"), "density 1 10500 kg/m^3 given: 1050 kg/m^3");
  EXPECT_THAT(text, HasSubstr("lattice units"));
}

TEST(Echo, FitsInHundredColumns) {
  for (const auto& text : {least_case, full_case, droplet_case, si_case}) {
    auto the_case = parse(text, {"flow.speed_limit=1e-9",  // for a warning
                                 "capsule.0.mesh={shape = \"spheroid\", aspect_ratio = 0.987654321, "
                                 "direction = [0.333333333, -1e-9, 123456.7]}",
                                 "capsule.0.stress_free.shape=biconcave"});
    the_case.title = "";
    const ShapeNumbers coarse{3.0, 1234.5678, 0.987654321, 0.987654321}, fine{0.1, 1234.5678, 0.9, 0.9};
    std::istringstream lines(echo_of(the_case, widest_cost(), {coarse, fine}));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100u) << line;
      EXPECT_FALSE(line.ends_with(' ')) << line;
    }
  }
}

TEST(Echo, EndsWithTheWarnings) {
  const auto the_case = parse(least_case);
  const auto text = echo(the_case, parameters(the_case), {}, {"one thing", "another thing"});
  EXPECT_TRUE(text.ends_with("warning: one thing\nwarning: another thing\n")) << text;
}

TEST(EchoTable, ParagraphsBreakBetweenWords) {
  EchoTable table(false);
  std::string long_text;
  for (int k = 0; k < 40; ++k) long_text += "words ";
  table.paragraph(long_text);
  std::istringstream lines(table.text());
  std::string first, second;
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(first.size(), 95u);  // sixteen words and fifteen spaces; one more word would make 101
  EXPECT_TRUE(second.starts_with("  words"));
}

TEST(EchoTable, LongValuesKeepTheirDistance) {
  EchoTable table(true);
  table.row("name", std::string(40, 'v'), "si", "note");
  EXPECT_THAT(table.text(), HasSubstr("vv si"));
}

}  // namespace
