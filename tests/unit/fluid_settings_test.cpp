// What the solvers refuse, and that the message names it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Nodes = std::vector<std::int64_t>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The message of the exception of this type that `act` throws; fails if it throws none.
template <typename Exception>
std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

LatticeBoltzmannSettings good_settings() {
  LatticeBoltzmannSettings settings;
  settings.shape = {5, 4, 3};
  settings.walls = moving_walls(2);
  settings.threads = 1;
  return settings;
}

struct BadSetting {
  std::string setting, value;
  std::function<void(LatticeBoltzmannSettings&)> spoil;
};
void PrintTo(const BadSetting& bad, std::ostream* out) {
  *out << bad.setting << " = " << bad.value;
}

class FluidBadSetting : public testing::TestWithParam<BadSetting> {};

TEST_P(FluidBadSetting, is_refused_by_name_and_value) {
  auto settings = good_settings();
  EXPECT_NO_THROW(make_lattice_boltzmann(settings));
  GetParam().spoil(settings);
  const auto says = AllOf(HasSubstr(GetParam().setting), HasSubstr(GetParam().value));
  EXPECT_THAT(message_of<std::invalid_argument>([&] { make_lattice_boltzmann(settings); }), says);
  EXPECT_THAT(message_of<std::invalid_argument>([&] { make_plain_lattice_boltzmann(settings); }), says);
}

INSTANTIATE_TEST_SUITE_P(
    every, FluidBadSetting,
    testing::Values(
        BadSetting{"shape.nx", "2", [](auto& settings) { settings.shape.nx = 2; }},
        BadSetting{"shape.ny", "0", [](auto& settings) { settings.shape.ny = 0; }},
        BadSetting{"shape.nz", "-3", [](auto& settings) { settings.shape.nz = -3; }},
        BadSetting{"relaxation_time", "0.5", [](auto& settings) { settings.relaxation_time = 0.5; }},
        BadSetting{"relaxation_time", "nan", [](auto& settings) { settings.relaxation_time = nan; }},
        BadSetting{"relaxation_time", "inf", [](auto& settings) { settings.relaxation_time = infinity; }},
        BadSetting{"magic_parameter", "0", [](auto& settings) { settings.magic_parameter = 0.0; }},
        BadSetting{"magic_parameter", "-0.25", [](auto& settings) { settings.magic_parameter = -0.25; }},
        BadSetting{"magic_parameter", "nan", [](auto& settings) { settings.magic_parameter = nan; }},
        BadSetting{"speed_limit", "0", [](auto& settings) { settings.speed_limit = 0.0; }},
        BadSetting{"speed_limit", "nan", [](auto& settings) { settings.speed_limit = nan; }},
        BadSetting{"threads", "-1", [](auto& settings) { settings.threads = -1; }},
        BadSetting{"body_force", "nan", [](auto& settings) { settings.body_force[1] = nan; }},
        BadSetting{"body_force", "inf", [](auto& settings) { settings.body_force[2] = infinity; }},
        BadSetting{"walls.axis", "3", [](auto& settings) { settings.walls->axis = 3; }},
        BadSetting{"walls.axis", "-1", [](auto& settings) { settings.walls->axis = -1; }},
        BadSetting{"walls.low_velocity", "nan",
                   [](auto& settings) { settings.walls->low_velocity[0] = nan; }},
        BadSetting{"walls.low_velocity along the wall axis", "0.01",
                   [](auto& settings) { settings.walls->low_velocity[2] = 0.01; }},
        BadSetting{"walls.high_velocity", "inf",
                   [](auto& settings) { settings.walls->high_velocity[1] = infinity; }},
        BadSetting{"walls.high_velocity along the wall axis", "-0.02",
                   [](auto& settings) { settings.walls->high_velocity[2] = -0.02; }},
        BadSetting{"start", "developed", [](auto& settings) {
                     settings.walls.reset();
                     settings.start = Start::developed;
                   }}));

/// Both solvers keep to the same border.
class FluidBorder : public testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<Fluid> fluid =
      GetParam() ? make_lattice_boltzmann(good_settings()) : make_plain_lattice_boltzmann(good_settings());
  const std::size_t n = static_cast<std::size_t>(fluid->shape().size());

  std::string refusal(const std::function<void()>& act) { return message_of<std::invalid_argument>(act); }
};
INSTANTIATE_TEST_SUITE_P(fast_and_plain, FluidBorder, testing::Bool());

TEST_P(FluidBorder, refuses_bad_viscosity) {
  Numbers viscosity(n, 0.1);
  for (const double bad : {0.0, -0.1, nan, infinity}) {
    viscosity[17] = bad;
    EXPECT_THAT(refusal([&] { fluid->set_viscosity(viscosity); }),
                AllOf(HasSubstr("viscosity of node 17"), HasSubstr("> 0")));
    EXPECT_THAT(refusal([&] {
                  fluid->set_viscosity(Nodes{3, 17, 2}, Numbers{0.1, bad, 0.1});
                }),
                AllOf(HasSubstr("viscosity of node 17"), HasSubstr("> 0")));
  }
  EXPECT_THAT(refusal([&] { fluid->set_viscosity(Numbers(n - 1, 0.1)); }),
              AllOf(HasSubstr("set_viscosity"), HasSubstr("59"), HasSubstr("60")));
  EXPECT_THAT(refusal([&] {
                fluid->set_viscosity(Nodes{3, 4}, Numbers{0.1});
              }),
              AllOf(HasSubstr("set_viscosity"), HasSubstr("1 values for 2 nodes")));
}

TEST_P(FluidBorder, refuses_arrays_of_the_wrong_size) {
  const std::vector<std::int64_t> nodes = {0, 59};
  Numbers five(5), all(n), all_three(3 * n);
  EXPECT_THAT(refusal([&] { fluid->velocity(nodes, five); }), AllOf(HasSubstr("velocity"), HasSubstr("5")));
  Numbers six(6), two(2), three(3);
  EXPECT_THAT(refusal([&] { fluid->free_velocity(nodes, five, two); }),
              AllOf(HasSubstr("free_velocity"), HasSubstr("5")));
  EXPECT_THAT(refusal([&] { fluid->free_velocity(nodes, six, three); }),
              AllOf(HasSubstr("free_velocity"), HasSubstr("mobility"), HasSubstr("3"), HasSubstr("2")));
  EXPECT_THAT(refusal([&] { fluid->add_force(nodes, five); }), AllOf(HasSubstr("add_force"), HasSubstr("5")));
  EXPECT_THAT(refusal([&] { fluid->moments(five, all_three); }), AllOf(HasSubstr("density"), HasSubstr("5")));
  EXPECT_THAT(refusal([&] { fluid->moments(all, five); }), AllOf(HasSubstr("velocity"), HasSubstr("5")));
}

TEST_P(FluidBorder, refuses_nodes_outside_the_box) {
  Numbers three(3), one(1);
  for (const std::int64_t node : {std::int64_t{-1}, std::int64_t{60}}) {
    const std::vector<std::int64_t> nodes = {node};
    const auto says = AllOf(HasSubstr("node " + std::to_string(node)), HasSubstr("0 to 59"));
    EXPECT_THAT(refusal([&] { fluid->velocity(nodes, three); }), says);
    EXPECT_THAT(refusal([&] { fluid->free_velocity(nodes, three, one); }), says);
    EXPECT_THAT(refusal([&] { fluid->add_force(nodes, three); }), says);
    EXPECT_THAT(refusal([&] { fluid->set_viscosity(nodes, Numbers{0.1}); }), says);
  }
}

TEST_P(FluidBorder, refuses_a_state_that_lacks_something) {
  const State good = fluid->state();
  for (const std::string name : {"populations", "force"}) {
    State without = good, short_of_one = good;
    std::erase_if(without.arrays, [&](const StateArray& array) { return array.name == name; });
    for (auto& array : short_of_one.arrays)
      if (array.name == name) array.values.pop_back();
    EXPECT_THAT(refusal([&] { fluid->restore(without); }), HasSubstr(name));
    EXPECT_THAT(refusal([&] { fluid->restore(short_of_one); }), HasSubstr(name));
  }
}

TEST_P(FluidBorder, refuses_a_state_with_something_it_does_not_know) {
  State state = fluid->state();
  state.arrays.push_back({"temperature", 1, Numbers(n)});
  EXPECT_THAT(refusal([&] { fluid->restore(state); }), HasSubstr("temperature"));
}

TEST_P(FluidBorder, refuses_a_negative_step_and_a_bad_viscosity_in_a_state) {
  State state = fluid->state();
  state.step = -2;
  EXPECT_THAT(refusal([&] { fluid->restore(state); }), AllOf(HasSubstr("step"), HasSubstr("-2")));
  fluid->set_viscosity(Numbers(n, 0.1));
  state = fluid->state();
  for (auto& array : state.arrays)
    if (array.name == "viscosity") array.values[3] = 0.0;
  EXPECT_THAT(refusal([&] { fluid->restore(state); }), HasSubstr("viscosity of node 3"));
}

// A refused state must not be half taken over.
TEST_P(FluidBorder, keeps_its_state_when_it_refuses_another) {
  disturb(*fluid);
  fluid->set_viscosity(Numbers(n, 0.1));
  fluid->step();
  const State before = fluid->state();
  State bad = before;
  bad.step = 7;
  for (auto& array : bad.arrays)
    for (auto& value : array.values) value *= 0.5;
  bad.arrays.back().values.pop_back();
  EXPECT_THROW(fluid->restore(bad), std::invalid_argument);
  EXPECT_EQ(difference(before, fluid->state()), "");
}

}  // namespace
}  // namespace tanktread::fluid::test
