// parameters.toml as another program reads it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "driver/program/version.hpp"
#include "driver/units/parameters_file.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;

toml::table read_back(const Parameters& parameters) {
  return toml::parse(parameters_toml(parameters, commit));
}

/// Written digits read back to the same double.
void expect_real(const toml::node_view<const toml::node>& node, double expected) {
  ASSERT_TRUE(node.is_floating_point());
  EXPECT_EQ(node.value<double>(), expected);
}

TEST(ParametersFile, HoldsTheSameNumbers) {
  const auto p = parameters(parse(
      least_case,
      {"membrane.viscous={scheme = \"fd\", boussinesq_shear = 10, spring_stiffness = 70, interval = 3}"}));
  const auto file = read_back(p);
  EXPECT_EQ(file["program"].value<std::string>(), std::string("tanktread ") + version);
  EXPECT_EQ(file["commit"].value<std::string>(), commit);
  const auto flow = std::as_const(file)["flow"];
  expect_real(flow["shear_rate"], p.shear_rate);
  expect_real(flow["wall_speed"], p.wall_speed);
  expect_real(flow["kinematic_viscosity"], p.kinematic_viscosity);
  expect_real(flow["relaxation_time_odd"], p.relaxation_time_odd);
  expect_real(flow["speed_limit"], p.speed_limit);
  expect_real(flow["reynolds_number"], p.reynolds_number);
  expect_real(flow["body_force"][0], 0.0);
  const auto capsule = std::as_const(file)["capsule"][0];
  const auto& expected = p.capsules.at(0);
  expect_real(capsule["radius"], 6.0);
  expect_real(capsule["shear_modulus"], expected.shear_modulus);
  expect_real(capsule["capillary_by_E_s"], expected.capillary_by_E_s);
  EXPECT_FALSE(capsule["interfacial_tension"]);
  const auto viscous = capsule["viscous"];
  EXPECT_EQ(viscous["interval"].value<int>(), 3);
  expect_real(viscous["shear_viscosity"], expected.viscous->shear_viscosity);
  expect_real(viscous["shear_spring"], expected.viscous->shear_spring);
  expect_real(viscous["interval_times_shear_spring"], 3 * expected.viscous->shear_spring);
  // Bq_s mu_o a/(mu_o a): two roundings.
  EXPECT_NEAR(*viscous["boussinesq_shear"].value<double>(), 10, 10 * 2.3e-16);
  EXPECT_FALSE(viscous["dilatational_viscosity"]);
}

TEST(ParametersFile, LeavesOutWhatACapsuleDoesNotHave) {
  const auto file = read_back(parameters(parse(least_case, {"membrane.elastic_law=interfacial-tension"})));
  const auto& capsule = *file["capsule"][0].as_table();
  EXPECT_TRUE(capsule.contains("interfacial_tension"));
  for (const char* name : {"shear_modulus", "skalak_modulus", "capillary_by_G_s", "viscous"}) {
    EXPECT_FALSE(capsule.contains(name)) << name;
  }
}

TEST(ParametersFile, HasACapsuleForEachOfTheCase) {
  EXPECT_EQ(read_back(parameters(parse(full_case)))["capsule"].as_array()->size(), 2u);
}

/// What a run has that went on from a parameters.toml of this text.
std::string commits_after(const std::string& text, const std::string& ours) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("parameters-{}.toml", ::getpid());
  std::ofstream(file) << text;
  const auto commits = commits_with(file, ours);
  std::filesystem::remove(file);
  return commits;
}

TEST(ParametersFile, NamesTheCommitsOfAllProgramsThatMadeARun) {
  // Sources without a commit, as from an archive, are a normal case: "unknown" is then the program's own.
  for (const std::string ours : {"248c18c6a8", "248c18c6a8+", "unknown"}) {
    EXPECT_EQ(commits_after("commit = \"" + ours + "\"\n", ours), ours);
    EXPECT_EQ(commits_after("commit = \"12ab\"\n", ours), "12ab, " + ours);
    EXPECT_EQ(commits_after("commit = \"12ab, " + ours + "\"\n", ours), "12ab, " + ours);
    EXPECT_EQ(commits_after("commit = \"" + ours + ", 12ab\"\n", ours), ours + ", 12ab, " + ours);
  }
}

TEST(ParametersFile, ARunWhoseCommitIsNotToBeReadWasMadeByAnUnknownOne) {
  for (const auto* text : {"", "commit = \"12ab", "commit = 12\n", "other = \"12ab\"\n"}) {
    EXPECT_EQ(commits_after(text, "248c18c6a8"), "unknown, 248c18c6a8") << text;
    EXPECT_EQ(commits_after(text, "unknown"), "unknown") << text;
  }
  EXPECT_EQ(commits_with("there/is/no/such/file.toml", "248c18c6a8"), "unknown, 248c18c6a8");
}

}  // namespace
