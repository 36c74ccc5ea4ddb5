// The implicit scheme of a membrane viscosity as a case gives it: what is refused beside it, its echo, its
// numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "driver/plan/echo.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/units/laws.hpp"
#include "membrane/implicit_viscosity.hpp"
#include "membrane/viscous_law.hpp"
#include "tests/unit/case_samples.hpp"
#include "tests/unit/echo_lines.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string viscous(const std::string& more, const std::string& scheme = "implicit") {
  return "membrane.viscous={scheme = \"" + scheme + "\", boussinesq_shear = 10" + (more.empty() ? "" : ", ") +
         more + "}";
}

struct Refused {
  std::vector<std::string> assignments;
  std::vector<std::string> message;
};

TEST(CaseImplicit, WhatContradictsIt) {
  const std::vector<Refused> all = {
      {{viscous("spring_stiffness = 1, spring_modulus = 2")},
       {"viscous.spring_stiffness",
        "give at most one of spring_stiffness, spring_relaxation_time, spring_modulus (2"}},
      {{viscous("spring_relaxation_time = 1, spring_modulus = 2")}, {"give at most one of spring_stiffness"}},
      {{viscous("spring_modulus_dilatational = 1, spring_stiffness_dilatational = 2")},
       {"give at most one of spring_stiffness_dilatational"}},
      {{viscous("interval = 3")},
       {"membrane.viscous.interval = 3: contradicts scheme = \"implicit\"", "in every step; remove it"}},
      {{viscous("strain_sampling = \"moving-average\"")},
       {"membrane.viscous.strain_sampling",
        "contradicts scheme = \"implicit\", which looks at no strain; remove it"}},
      // Also at their defaults, which mean nothing here.
      {{viscous("interval = 1")}, {"interval = 1: contradicts scheme"}},
      {{viscous("strain_sampling = \"latest\"")}, {"which looks at no strain"}},
      {{viscous("stress_measure = \"rate-of-deformation\"")}, {"stress_measure", "contradicts scheme"}},
      {{viscous("stress_measure = \"rate-of-strain\"")},
       {"membrane.viscous.stress_measure = \"rate-of-strain\": contradicts scheme = \"implicit\"",
        "or use scheme"}},
      {{viscous("strain_rates = \"edges\"")},
       {"strain_rates", "one of \"elements\", \"nodes\" (default \"elements\")"}},
      {{viscous("spring_stiffness = 100, strain_rates = \"nodes\"", "fd")},
       {"membrane.viscous.strain_rates = \"nodes\": is of scheme = \"implicit\" only; remove it"}},
      {{"flow.command=[\"sh\"]", viscous("")},
       {"membrane.viscous.scheme = \"implicit\": contradicts flow.command", "use \"fd\" with a spring"}},
      {{"coupler.implicit_tolerance=1e-6"},
       {"--set coupler.implicit_tolerance=1e-6: is of membrane.viscous.scheme = \"implicit\", which no "
        "capsule has"}},
      {{"coupler.implicit_iterations=10"},
       {"coupler.implicit_iterations=10: is of", "which no capsule has; remove it"}},
      {{viscous("spring_stiffness = 100", "fd"), "coupler.implicit_tolerance=1e-6"},
       {"which no capsule has"}},
      {{viscous(""), "coupler.implicit_tolerance=0"}, {"a number > 0 and <= 0.1 (default 0.001)"}},
      {{viscous(""), "coupler.implicit_tolerance=0.2"}, {"a number > 0 and <= 0.1"}},
      {{viscous(""), "coupler.implicit_iterations=0"}, {"an integer >= 1 and <= 1000000 (default 1000)"}},
      {{viscous("", "implict")}, {"did you mean \"implicit\"?"}},
  };
  for (const auto& bad : all) {
    const auto message = refusal(least_case, bad.assignments);
    for (const auto& piece : bad.message) EXPECT_THAT(message, HasSubstr(piece)) << bad.assignments.front();
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << "one problem, not several";
  }
}

TEST(CaseImplicit, WhatFitsIt) {
  const std::vector<std::vector<std::string>> all = {
      {viscous("")},  // no spring is needed
      {viscous("spring_stiffness = 100")},
      {viscous("spring_relaxation_time = 0.01")},
      {viscous("spring_modulus = 1e-3")},
      {viscous("spring_relaxation_time_dilatational = 0.01, boussinesq_dilatational = 2")},
      {viscous("strain_rates = \"elements\""), "coupler.implicit_tolerance=1e-9",
       "coupler.implicit_iterations=7"},
      // A program in the place of the membrane has its own viscosity: nothing is asked of the fluid.
      {"flow.command=[\"sh\"]", "membrane.command=[\"sh\"]", viscous("")},
      // The viscosity is switched off by its scheme alone.
      {viscous("strain_rates = \"elements\"", "none")},
  };
  for (const auto& good : all) {
    EXPECT_EQ(refusal(least_case, good), "") << good.front();
    const auto the_case = parse(least_case, good);
    const auto again = parse(to_toml(the_case));
    EXPECT_TRUE(again == the_case) << to_toml(the_case);
    EXPECT_EQ(to_toml(again), to_toml(the_case));
  }
}

TEST(CaseImplicit, OneCapsuleOfSeveralMayHaveIt) {
  const std::string two = least_case.substr(0, least_case.find("[membrane]")) + R"([[capsule]]
radius = 3.0
position = [6.0, 20.0, 22.0]
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 3.0, strain_rates = "nodes" } }
[membrane]
capillary_number = 0.3
viscous = { scheme = "fd", boussinesq_shear = 1.0, spring_stiffness = 100.0 }
[coupler]
implicit_tolerance = 1e-8
)";
  EXPECT_EQ(refusal(two), "");
  const auto the_case = parse(two);
  EXPECT_TRUE(parse(to_toml(the_case)) == the_case) << to_toml(the_case);
  EXPECT_EQ(the_case.capsules[1].membrane.viscous.strain_rates, "nodes");
  const auto numbers = parameters(the_case);
  EXPECT_TRUE(any_implicit(the_case, numbers));
  const auto meshes = membrane_shapes(the_case).meshes;
  EXPECT_EQ(implicit_viscosity(numbers.capsules[0], meshes[0], 1), nullptr);
  EXPECT_NE(implicit_viscosity(numbers.capsules[1], meshes[1], 1), nullptr);
  EXPECT_NE(viscous_law(numbers.capsules[0]), nullptr);
  EXPECT_EQ(viscous_law(numbers.capsules[1]), nullptr);
}

TEST(CaseImplicit, WithoutAViscosityOrWithAProgramThereIsNone) {
  for (const std::vector<std::string>& assignments :
       {std::vector<std::string>{"membrane.viscous.scheme=implicit"},
        {viscous("", "none")},
        {"membrane.command=[\"sh\"]", viscous("")}}) {
    const auto the_case = parse(least_case, assignments);
    EXPECT_FALSE(any_implicit(the_case, parameters(the_case))) << assignments.front();
  }
}

/// theta of the shear and the dilatational part: what of a stress of 1 is remembered.
std::pair<double, double> relaxation(const std::vector<std::string>& assignments) {
  const auto the_case = parse(least_case, assignments);
  const auto made =
      implicit_viscosity(parameters(the_case).capsules[0], membrane_shapes(the_case).meshes[0], 1);
  made->accept(Eigen::Matrix3Xd::Ones(3, made->rates().n_rates()));
  Eigen::Matrix3Xd memory = Eigen::Matrix3Xd::Zero(3, made->rates().n_rates());
  made->add_memory(memory);
  return {memory(0, 0), memory(2, 0)};
}

// Products and quotients of three or four numbers: a few roundings, below 1e-15 of the result each.
TEST(CaseImplicit, RelaxesInTwiceTheTimeOfItsSpring) {
  const double g = parameters(parse(least_case)).shear_rate;
  const auto none = relaxation({viscous("")});
  EXPECT_EQ(none.first, 0);
  EXPECT_EQ(none.second, 0);
  const std::string both = "boussinesq_dilatational = 5, ";
  // tau g = 0.25 for both, where the dilatation has no spring of its own.
  const auto shared = relaxation({viscous(both + "spring_relaxation_time = 0.25")});
  EXPECT_NEAR(shared.first * g, 0.5, 1e-14);
  EXPECT_NEAR(shared.second * g, 0.5, 1e-14);
  // kappa = 2/(tau g).
  const auto two = relaxation({viscous(both + "spring_stiffness = 16, spring_stiffness_dilatational = 4")});
  EXPECT_NEAR(two.first * g, 0.25, 1e-14);
  EXPECT_NEAR(two.second * g, 1, 1e-14);
  const auto one = relaxation({viscous(both + "spring_stiffness_dilatational = 4")});
  EXPECT_EQ(one.first, 0) << "a dashpot beside a Maxwell element";
  EXPECT_NEAR(one.second * g, 1, 1e-14);
}

TEST(CaseImplicit, RatesAreWhereTheCaseSays) {
  for (const std::string where : {"nodes", "elements"}) {
    const auto the_case = parse(least_case, {viscous("strain_rates = \"" + where + "\"")});
    const auto meshes = membrane_shapes(the_case).meshes;
    const auto made = implicit_viscosity(parameters(the_case).capsules[0], meshes[0], 1);
    EXPECT_EQ(made->rates().n_rates(),
              where == "nodes" ? meshes[0].points.cols() : meshes[0].triangles.cols());
  }
  EXPECT_EQ(parse(least_case, {viscous("")}).capsules[0].membrane.viscous.strain_rates, "elements");
}

TEST(CaseImplicit, TheEchoSaysHowItIsSolvedAndThatThereIsNoSpring) {
  const auto text = echo_of(parse(least_case, {viscous("")}));
  EXPECT_EQ(line_of(text, "viscous scheme"),
            "viscous scheme implicit strain rates by elements, to 0.001 in at most 1000 iterations");
  EXPECT_THAT(line_of(text, "Bq_s"), StartsWith("Bq_s 10 "));
  EXPECT_EQ(line_of(text, "k_s'"), "k_s' none a dashpot without a spring");
  EXPECT_EQ(line_of(text, "Bq_d"), "Bq_d 0");
  for (const char* name :
       {"interval N", "kappa_s", "N k_s'", "largest kappa_s", "largest N", "tau_s", "k_d'"})
    EXPECT_EQ(line_of(text, name), "") << name;
  EXPECT_THAT(text, Not(AllOf(HasSubstr("warning"), HasSubstr("viscous"))));
}

TEST(CaseImplicit, TheEchoOfASpringHasNoLimitsOfAnExplicitScheme) {
  const auto text =
      echo_of(parse(least_case, {viscous("spring_stiffness = 1e6, strain_rates = \"nodes\""),
                                 "coupler.implicit_tolerance=1e-8", "coupler.implicit_iterations=50"}));
  EXPECT_EQ(line_of(text, "viscous scheme"),
            "viscous scheme implicit strain rates by nodes, to 1e-08 in at most 50 iterations");
  EXPECT_THAT(line_of(text, "kappa_s"), StartsWith("kappa_s 1e+06 "));
  EXPECT_NE(line_of(text, "tau_s"), "");
  for (const char* name : {"interval N", "N k_s'", "largest kappa_s", "largest N"})
    EXPECT_EQ(line_of(text, name), "") << name;
  EXPECT_THAT(text, Not(HasSubstr("unstable")));
}

TEST(CaseImplicit, AKeyThatHasNoEffectIsWarnedOf) {
  const auto text = echo_of(parse(least_case, {"membrane.viscous={strain_rates = \"nodes\"}"}));
  EXPECT_THAT(text, HasSubstr("viscous.scheme = \"none\" leaves it out"));
  EXPECT_THAT(echo_of(parse(least_case, {"membrane.viscous.scheme=implicit"})),
              HasSubstr("viscous.scheme = \"implicit\", but both Boussinesq numbers are 0"));
}

}  // namespace
