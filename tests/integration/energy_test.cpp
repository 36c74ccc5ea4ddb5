// energy.csv: the budget closes, and the table goes on with the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driver/observe/energy.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/step.hpp"
#include "tests/integration/resume_fixture.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/// 500 steps a shear time.
constexpr const char* capsule_in_shear = R"([flow]
box = [20, 20, 20]
wall_speed = 0.02
start = "developed"
inertia = false
[[capsule]]
radius = 6.0
position = [10.0, 10.0, 10.0]
mesh = { level = 3 }
[membrane]
capillary_number = 0.3
)";

System make(const Case& the_case) {
  const auto p = parameters(the_case);
  return make_system(the_case, p, membrane_shapes(the_case));
}

EnergyBudget budget_after(int n_steps, const std::vector<std::string>& assignments) {
  const auto the_case = parse_case(capsule_in_shear, "shear.toml", "/", assignments);
  auto system = make(the_case);
  for (int k = 0; k < n_steps; ++k) advance(system);
  return energy_budget(system, the_case);
}

/// A case, and the columns that it is about.
struct Budget {
  std::string name;
  std::vector<std::string> assignments;
  std::vector<double EnergyBudget::*> columns;
};
std::ostream& operator<<(std::ostream& out, const Budget& budget) {
  return out << budget.name;
}

using B = EnergyBudget;
const std::vector<std::string> springs = {"membrane.viscous.boussinesq_shear=5",
                                          "membrane.viscous.spring_relaxation_time=0.5"};
std::vector<std::string> with_springs(const std::string& scheme) {
  auto assignments = springs;
  assignments.insert(assignments.begin(), "membrane.viscous.scheme=" + scheme);
  return assignments;
}

const std::vector<std::string> with_energies = {"membrane.bending_modulus=0.1",
                                                "membrane.global_area_modulus=5",
                                                "membrane.local_area_modulus=5", "membrane.volume_modulus=5"};

const Budget budgets[] = {
    {"elastic", {}, {&B::walls, &B::inner, &B::outer, &B::elastic_power, &B::correction}},
    {"without_correction",
     {"coupler.tangential_correction=false"},
     {&B::walls, &B::outer, &B::elastic_power}},
    {"volume_kept", {"coupler.keep_volume=true"}, {&B::elastic_power, &B::correction}},
    {"implicit",
     {"membrane.viscous.scheme=implicit", "membrane.viscous.boussinesq_shear=10"},
     {&B::viscous_shear, &B::correction}},
    {"implicit_at_nodes",
     {"membrane.viscous.scheme=implicit", "membrane.viscous.boussinesq_shear=10",
      "membrane.viscous.strain_rates=nodes"},
     {&B::viscous_shear, &B::correction}},
    {"dilatational",
     {"membrane.viscous.scheme=implicit", "membrane.viscous.boussinesq_dilatational=20",
      "membrane.capillary_number=1"},
     {&B::viscous_dilatational, &B::correction}},
    {"implicit_with_springs", with_springs("implicit"), {&B::viscous_shear, &B::spring_power}},
    {"fd", with_springs("fd"), {&B::viscous_shear, &B::spring_power}},
    {"int2", with_springs("int2"), {&B::viscous_shear, &B::spring_power}},
    {"load",
     {"capsule.0.load={ force = 3, direction = [1, 0, -0.5], patch = 0.1 }"},
     {&B::load_power, &B::elastic_power}},
    {"contrast", {"flow.viscosity_ratio=5"}, {&B::inner, &B::outer, &B::elastic_power}},
    {"inertia_and_single_precision",
     {"flow.inertia=true", "flow.storage=single", "flow.relaxation_time=0.8"},
     {&B::walls, &B::elastic_power, &B::correction}},
    {"energies", with_energies, {&B::walls, &B::elastic_power}},
    {"energies_with_implicit_viscosity",
     {"membrane.viscous.scheme=implicit", "membrane.viscous.boussinesq_shear=10",
      "membrane.bending_modulus=0.1", "membrane.local_area_modulus=5"},
     {&B::viscous_shear, &B::correction}},
    {"body_force",
     {"flow.kind=poiseuille", "flow.wall_axis=x", "flow.flow_axis=z", "capsule.0.position=[9, 10, 10]"},
     {&B::body_force, &B::outer, &B::elastic_power}},
};

class EnergyOf : public ::testing::TestWithParam<Budget> {};
INSTANTIATE_TEST_SUITE_P(Each, EnergyOf, ::testing::ValuesIn(budgets),
                         [](const auto& tested) { return tested.param.name; });

// What is left is what the lattice loses besides 2 mu S:S, and a part of the order of a step. The loss in a
// channel of H nodes is 3/2 H^-2 of the power (fluid_power_test): 0.4 % at H = 20, and 0.7 % about a capsule
// with a diameter and a gap of 12 and 8 nodes would be much. Every column that a case is about is above that,
// so that its sign counts, and that it is there.
TEST_P(EnergyOf, ACapsuleCloses) {
  const auto budget = budget_after(250, GetParam().assignments);
  const double input = budget.walls + budget.body_force;
  EXPECT_GT(input, 0);
  EXPECT_LT(std::abs(budget.remainder), 0.007 * input);
  for (const auto column : GetParam().columns) EXPECT_GT(std::abs(budget.*column), 0.007 * input);
}

// Nothing but the walls and the fluid: both are exact, and so is the kinetic energy, the sum of 2 (U s/H)^2.
TEST(Energy, OfTheUndisturbedFlowIsThatOfCouetteFlow) {
  const auto budget = budget_after(0, {});
  const double g = 2 * 0.02 / 20, viscosity = 1.0 / 6.0, n_nodes = 20 * 20 * 20;
  // 40 roundings a node, and no more than 10^4 terms of either sign.
  const double rounding = 1e-12 * n_nodes * viscosity * g * g;
  EXPECT_NEAR(budget.inner + budget.outer, n_nodes * viscosity * g * g, rounding);
  EXPECT_NEAR(budget.walls, budget.inner + budget.outer, rounding);
  EXPECT_NEAR(budget.remainder, 0, 10 * rounding);
  double kinetic = 0;
  for (int k = 0; k < 20; ++k) kinetic += 0.5 * std::pow(g * (k + 0.5 - 10), 2);
  EXPECT_NEAR(budget.kinetic_energy, 400 * kinetic, 1e-12 * 400 * kinetic);
  for (const double power : {budget.body_force, budget.viscous_shear, budget.spring_power})
    EXPECT_EQ(power, 0);
}

// The elastic energy is told by the law, its rate by forces and velocities. Nodes move from t to t + 1 with
// u_m(t), so that the trapezoidal rule is off by half the change of u_m in a step: at the start of a flow,
// where it falls by a fifth in 50 steps, by some 0.2 %.
TEST(Energy, TheElasticPowerIsTheRateOfTheElasticEnergy) {
  const auto the_case = parse_case(capsule_in_shear, "shear.toml", "/");
  auto system = make(the_case);
  for (int k = 0; k < 50; ++k) advance(system);
  auto before = energy_budget(system, the_case);
  const double at_first = before.elastic_energy;
  double stored = 0;
  for (int k = 0; k < 50; ++k) {
    advance(system);
    const auto now = energy_budget(system, the_case);
    stored += 0.5 * (before.elastic_power + now.elastic_power);
    before = now;
  }
  EXPECT_NEAR(stored / (before.elastic_energy - at_first), 1, 5e-3);
}

// Likewise of each energy beside the law, but that of the stiffest, the local area, takes most of its power
// at once, and the velocities that do it fall to a third: half of the change of u_m in 50 steps is then up to
// 2 %. They take up so much that the budget would not close without them.
TEST(Energy, ThePowerOfATermIsTheRateOfItsEnergy) {
  const auto the_case = parse_case(capsule_in_shear, "shear.toml", "/", with_energies);
  auto system = make(the_case);
  for (int k = 0; k < 50; ++k) advance(system);
  auto before = energy_budget(system, the_case);
  const auto at_first = before;
  ASSERT_EQ(before.terms.size(), 4u);
  std::vector<double> stored(4, 0.0);
  double power = 0;
  for (int k = 0; k < 50; ++k) {
    advance(system);
    const auto now = energy_budget(system, the_case);
    for (std::size_t term = 0; term < 4; ++term)
      stored[term] += 0.5 * (before.terms[term].power + now.terms[term].power);
    before = now;
  }
  for (std::size_t term = 0; term < 3; ++term) {
    EXPECT_NEAR(stored[term] / (before.terms[term].energy - at_first.terms[term].energy), 1, 2e-2)
        << before.terms[term].name;
    power += before.terms[term].power;
  }
  // The volume hardly changes.
  EXPECT_EQ(before.terms[3].name, "volume");
  EXPECT_LT(std::abs(before.terms[3].power), 1e-3 * before.elastic_power);
  EXPECT_GT(power, 0.015 * before.walls);
}

TEST(Energy, DoesNotDependOnThreads) {
  const std::vector<std::string> contrast = {"flow.viscosity_ratio=3", "membrane.viscous.scheme=fd",
                                             "membrane.viscous.boussinesq_shear=5",
                                             "membrane.viscous.spring_stiffness=10"};
  auto one = contrast, three = contrast;
  one.emplace_back("run.threads=1");
  three.emplace_back("run.threads=3");
  EXPECT_EQ(energy_row(budget_after(20, one)), energy_row(budget_after(20, three)));
}

TEST(Energy, IsRefusedWithAProgramThatIsNotAskedForIt) {
  for (const std::string program : {"flow.command", "membrane.command"}) {
    const auto message = refusal(least_case, {program + "=[\"sh\"]", "output.energy_every=0.1"});
    EXPECT_THAT(message, AllOf(HasSubstr("output.energy_every"), HasSubstr(program), HasSubstr("remove")));
    EXPECT_EQ(refusal(least_case, {program + "=[\"sh\"]"}), "");
  }
  EXPECT_THAT(refusal(least_case, {"output.energy_every=-1"}), HasSubstr("must be a number >= 0"));
}

class EnergyTable : public Resume {
 protected:
  static constexpr const char* with_energy = "output.energy_every=0.04";
  std::string table(const std::string& name) const { return read_file(directory_ / name / "energy.csv"); }
};

TEST_F(EnergyTable, IsWrittenIfItIsAskedFor) {
  ASSERT_EQ(run_program(run_to("none", {"--shear-time", "0.1"})).exit_code, 0);
  EXPECT_FALSE(fs::exists(directory_ / "none/energy.csv"));
  ASSERT_EQ(run_program(run_to("all", {"--shear-time", "0.1", "--set", with_energy})).exit_code, 0);
  const auto text = table("all");
  EXPECT_THAT(text, StartsWith("step,shear_time,elastic_energy,elastic_power,viscous_shear,"
                               "viscous_dilatational,spring_power,inner,outer,walls,body_force,correction,"
                               "kinetic_energy,remainder,load_power\n0,0,"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 4) << "steps 0, 24, 48 and the end, 60";
  // Nothing else is another.
  for (const char* file : {"observables.csv", "parameters.toml", "checkpoints/step_0000000060/fluid.vti",
                           "checkpoints/step_0000000060/membrane.vtu"})
    EXPECT_EQ(read_file(directory_ / "none" / file), read_file(directory_ / "all" / file)) << file;
}

TEST_F(EnergyTable, ARunGoesOnWithIt) {
  const std::vector<std::string> viscous = {
      "--set", "membrane.viscous.scheme=implicit", "--set", "membrane.viscous.boussinesq_shear=5",
      "--set", "output.measures_every=0.05",       "--set", with_energy};
  const auto to = [&](const char* shear_time) {
    auto more = viscous;
    more.insert(more.end(), {"--shear-time", shear_time});
    return more;
  };
  ASSERT_EQ(run_program(run_to("whole", to("0.4"))).exit_code, 0);
  ASSERT_EQ(run_program(run_to("half", to("0.3"))).exit_code, 0);
  for (const char* from : {"120", "180"}) {
    const auto run = copy_of_half("out");
    const auto ended = resume(run, {"--shear-time", "0.4", "--from-step", from});
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_EQ(table("out"), table("whole")) << from;
  }
  const auto gone = copy_of_half("gone");
  fs::remove(gone / "energy.csv");
  const auto refused = resume(gone, {"--shear-time", "0.4"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("energy.csv: is missing"));
}

// One part cannot tell inside from outside, so the whole cannot.
TEST(Energy, OfPartsOfWhichOneDoesNotKnowWhatIsInside) {
  FlowBudget known, unknown;
  known.inner.add(2);
  known.outer.add(3);
  unknown.knows_inside = false;
  unknown.outer.add(10);
  for (const bool known_first : {true, false}) {
    auto sum = known_first ? known : unknown;
    sum.add(known_first ? unknown : known);
    const auto budget = energy_budget(7, 0.5, {}, sum);
    EXPECT_TRUE(std::isnan(budget.inner));
    EXPECT_EQ(budget.outer, 15);
    EXPECT_EQ(budget.remainder, -15);
  }
  auto twice = known;
  twice.add(known);
  const auto budget = energy_budget(7, 0.5, {}, twice);
  EXPECT_EQ(budget.inner, 4);
  EXPECT_EQ(budget.outer, 6);
  EXPECT_EQ(budget.step, 7);
}

}  // namespace
