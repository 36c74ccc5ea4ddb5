// The model of a step's error against what was measured: cases/cost-of-accuracy/measured/results.csv.
#include "driver/plan/step_error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "driver/plan/step_advice.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;

/// A run of the map, or of the group `elsewhere`.
struct Measured {
  std::string run;
  StepNumbers numbers;
  double deformation, inclination_deg;

  bool is_of(const std::string& family) const { return run.starts_with(family); }
};

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// "step-inertia-tau2-u3.2e-2": tau+ = 2.
double relaxation_time_of(const std::string& run) {
  return std::stod(run.substr(run.find("-tau") + 4));
}

Measured measured_of(const std::map<std::string, std::string>& row) {
  const auto& run = row.at("run");
  const double nu = (relaxation_time_of(run) - 0.5) / 3, radius = std::stod(row.at("radius"));
  const double speed = std::stod(parts_of(row.at("shear_rate_by"), ' ')[1]);
  const double g = 2 * speed / std::stod(row.at("box"));
  const double capillary = std::stod(row.at("capillary_number"));
  return {
      run,
      {g * radius * radius / nu, 3 * nu * g, row.at("capillary_modulus") == "E_s" ? 2 * capillary : capillary,
       row.at("inertia") != "false", run.starts_with("elsewhere-rest")},
      std::stod(row.at("deformation")),
      std::stod(row.at("inclination_deg"))};
}

std::vector<Measured> all_measured() {
  std::ifstream file(TANKTREAD_SOURCE "/cases/cost-of-accuracy/measured/results.csv");
  std::vector<std::string> header;
  std::vector<Measured> found;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    const auto values = parts_of(line, ',');
    if (header.empty()) {
      header = values;
    } else if (values[0].starts_with("step-") || values[0].starts_with("elsewhere-")) {
      std::map<std::string, std::string> row;
      for (std::size_t k = 0; k < header.size(); ++k) row[header[k]] = k < values.size() ? values[k] : "";
      found.push_back(measured_of(row));
    }
  }
  return found;
}

const std::vector<Measured> measured = all_measured();

std::vector<Measured> family(const std::string& name) {
  std::vector<Measured> found;
  for (const auto& run : measured) {
    if (run.is_of(name)) found.push_back(run);
  }
  return found;
}

/// From the first run of a family, the one with the smallest step, to another: in what was measured.
ShapeError change(const Measured& from, const Measured& to) {
  return {std::log(to.deformation / from.deformation), to.inclination_deg - from.inclination_deg};
}

/// In the model.
ShapeError modelled(const Measured& from, const Measured& to) {
  const auto a = step_error(from.numbers).early(), b = step_error(to.numbers).early();
  return {b.deformation - a.deformation, b.inclination_deg - a.inclination_deg};
}

TEST(StepError, TheMapIsMet) {
  const auto map = family("step-");
  ASSERT_EQ(map.size(), 11);
  for (const auto& run : map) {
    SCOPED_TRACE(run.run);
    const auto found = change(map.front(), run), model = modelled(map.front(), run);
    // Terms of the next order in the step are left out: of a change of 3 % by inertia, the largest, its
    // square, 0.05 to 0.1 %, is what the fit has a term for; what is left is of the third order, under 0.01
    // %, or 0.01 degrees.
    EXPECT_NEAR(model.deformation, found.deformation, 2e-4);
    EXPECT_NEAR(model.inclination_deg, found.inclination_deg, 0.01);
  }
}

/// The sum of what its parts are, each without its sign.
ShapeError size_of_parts(const Measured& run) {
  const auto error = step_error(run.numbers);
  ShapeError sum;
  for (const auto& part : {error.unsteady, error.compression, error.inertia}) {
    sum.deformation += std::abs(part.deformation);
    sum.inclination_deg += std::abs(part.inclination_deg);
  }
  return sum;
}

class Elsewhere : public ::testing::TestWithParam<const char*> {};

TEST_P(Elsewhere, TheModelIsAboutRight) {
  const auto runs = family(std::string("elsewhere-") + GetParam() + "-");
  ASSERT_GE(runs.size(), 3);
  for (const auto& run : runs) {
    SCOPED_TRACE(run.run);
    const auto found = change(runs.front(), run), model = modelled(runs.front(), run);
    const auto parts = size_of_parts(run), less = size_of_parts(runs.front());
    // What the manual promises: "about", to within 40 % of what the parts of an error amount to. The inertia
    // of a capsule in another box and the compression under another law differ by so much (1.4 and 0.6 times
    // the model's).
    EXPECT_NEAR(model.deformation, found.deformation, 0.4 * (parts.deformation + less.deformation));
    EXPECT_NEAR(model.inclination_deg, found.inclination_deg,
                0.01 + 0.4 * (parts.inclination_deg + less.inclination_deg));
  }
}

INSTANTIATE_TEST_SUITE_P(StepError, Elsewhere,
                         ::testing::Values("ca0.3", "ca0.1", "ca0.6", "neo-hookean", "box9", "rest", "bgk"),
                         [](const auto& name) {
                           std::string text = name.param;
                           std::erase_if(text, [](char letter) { return !std::isalnum(letter); });
                           return text;
                         });

TEST(StepError, TheUnsteadyPartIsGoneWhereTheShapeStandsStill) {
  const StepNumbers numbers{0.5, 1e-3, 0.6, false, false};
  const auto error = step_error(numbers);
  EXPECT_DOUBLE_EQ(error.early().deformation - error.late().deformation, error.unsteady.deformation);
  // Of unlike sign: the largest error is that of a time when one of them is alone, or the other outweighs it.
  EXPECT_LT(error.unsteady.deformation, 0);
  EXPECT_GT(error.compression.deformation, 0);
  EXPECT_DOUBLE_EQ(error.largest().deformation,
                   std::max(error.late().deformation, -error.early().deformation));
}

TEST(StepError, TheLongestStepHasTheErrorAskedForOrIsTheLargestMeasured) {
  for (const bool inertia : {false, true}) {
    for (const double capillary : {0.2, 0.6, 1.2}) {
      const StepNumbers numbers{0.1, 0.5e-3, capillary, inertia, false};
      for (const double accuracy : {1e-4, 1e-3, 5e-3}) {
        const double times = longest_step(numbers, accuracy);
        const StepNumbers longer{times * numbers.reynolds, times * numbers.compression, capillary, inertia,
                                 false};
        const double error = step_error(longer).largest().deformation;
        EXPECT_LE(error, accuracy * (1 + 1e-12));
        EXPECT_LE(times, longest_measured_step(numbers));
        if (times < longest_measured_step(numbers)) {
          EXPECT_NEAR(error, accuracy, 1e-9);
        }
      }
    }
  }
}

const std::vector<std::string> map_keys = {"flow.box=[60, 60, 60]",
                                           "capsule.0.position=[30, 30, 30]",
                                           "capsule.0.radius=9.549",
                                           "flow.inertia=false",
                                           "flow.start=\"developed\"",
                                           "membrane.capillary_number=0.3",
                                           "membrane.capillary_modulus=\"E_s\""};

std::string reason(std::vector<std::string> keys, const std::string& speed = "flow.reynolds_number=0.146") {
  keys.insert(keys.begin(), map_keys.begin(), map_keys.end());
  keys.push_back(speed);
  const auto the_case = parse(least_case, keys);
  return not_measured(the_case, parameters(the_case));
}

TEST(StepError, NothingIsSaidOfWhatWasNotMeasured) {
  EXPECT_EQ(reason({}), "");
  EXPECT_EQ(reason({"flow.collision=\"bgk\""}), "");
  EXPECT_THAT(reason({"flow.collision=\"bgk\"", "flow.relaxation_time=1.5"}), HasSubstr("flow.collision"));
  EXPECT_THAT(reason({"flow.magic_parameter=0.25"}), HasSubstr("flow.magic_parameter"));
  EXPECT_THAT(reason({"flow.kind=\"poiseuille\""}), HasSubstr("flow.kind"));
  EXPECT_THAT(reason({"flow.body_force=[1e-6, 0, 0]"}), HasSubstr("flow.body_force"));
  EXPECT_THAT(reason({"coupler.kernel=\"cosine4\""}), HasSubstr("[coupler]"));
  EXPECT_THAT(reason({"coupler.keep_volume=true"}), HasSubstr("[coupler]"));
  EXPECT_THAT(reason({"flow.relaxation_time=3.5"}), HasSubstr("tau+ = 3.5: measured was 1 to 3"));
  EXPECT_THAT(reason({"flow.relaxation_time=0.8"}), HasSubstr("tau+"));
  EXPECT_THAT(reason({"capsule.0.radius=5"}), HasSubstr("radius = 5: measured was 6.3 to 9.6"));
  EXPECT_THAT(reason({"flow.box=[60, 56, 60]"}),
              HasSubstr("over the radius = 5.864: measured was 6.2 to 9.1"));
  EXPECT_THAT(reason({"membrane.capillary_number=1.0"}), HasSubstr("Ca_G = 2: measured was 0.2 to 1.2"));
  EXPECT_THAT(reason({}, "flow.reynolds_number=1.0"), HasSubstr("Re = 1: measured was 0 to 0.6"));
  EXPECT_THAT(reason({"membrane.viscous.scheme=\"fd\"", "membrane.viscous.boussinesq_shear=1",
                      "membrane.viscous.spring_stiffness=10"}),
              HasSubstr("membrane.viscous"));
}

TEST(StepAdvice, NamesTheKeyThatTheCaseHas) {
  auto keys = map_keys;
  keys.push_back("flow.reynolds_number=0.1");
  const auto the_case = parse(least_case, keys);
  const auto p = parameters(the_case);
  // Without inertia the error at tau+ = 1 is in proportion to the step; at Re = 0.1, K = Re/a^2/12: early
  // -0.085 %
  // + 1.747 K.
  const double k = 3 * 0.1 / (6 * 6) / (9.549 * 9.549), error = 0.00085 - 1.275 / 0.73 * k;
  const double times = 0.001 / error;
  const auto line = accuracy_line(the_case, p, 0.001);
  EXPECT_THAT(line, HasSubstr(fmt::format(
                        "D within 0.1 % by the step at tau+ = 1 with --set flow.reynolds_number={:.3g}",
                        std::floor(100 * times) / 1000)));
  EXPECT_THAT(accuracy_line(the_case, p, 1), HasSubstr("6 times fewer, most measured"));  // Re = 0.6
  EXPECT_THAT(accuracy_line(parse(least_case, {"flow.kind=\"poiseuille\""}), p, 0.001),
              HasSubstr("accuracy 0.001: the step's error is not known here: flow.kind"));
}

}  // namespace
