// A run with energies beside the elastic law: its parts add up, it goes on, and each component by itself is
// it, bit for bit.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "exchange/vtk_files.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* all_energies = R"(bending_modulus = 0.02
spontaneous_curvature = 1
global_area_modulus = 2
local_area_modulus = 3
volume_modulus = 4
reference_volume = 0.98
)";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream input(line);
  for (std::string cell; std::getline(input, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The second capsule, which is viscous, has no energy of bending.
class Energies : public Stages {
 protected:
  void SetUp() override {
    std::string text = staged_case;
    const std::string shared = "[membrane]\ncapillary_number = 0.3\n", own = "capillary_number = 0.1\n";
    text.insert(text.find(shared) + shared.size(), all_energies);
    text.insert(text.find(own) + own.size(), "bending_modulus = 0\n");
    std::ofstream(path("case.toml")) << text;
  }

  static std::vector<double> array(const exchange::SurfacePacket& file, const std::string& name) {
    return exchange::find_array(file.point_data, name, "the file").values;
  }
};

TEST_F(Energies, StagedEqualsFused) {
  record();
  stage({"membrane", "--out", path("membrane.vtu")});
  stage({"fluid", "--steps", "0", "--out", path("fluid.vti"), "--fields", path("flow.vti")});
  for (int step = 0; step < 20; ++step) {
    stage({"coupler", "interpolate", "--in", path("membrane.vtu"), "--grid", path("flow.vti"), "--out",
           path("velocity.vtu")});
    stage({"membrane", "--in", path("velocity.vtu"), "--move", "--state", path("membrane.vtu"), "--out",
           path("membrane.vtu")});
    stage({"coupler", "spread", "--in", path("membrane.vtu"), "--out", path("force.vti")});
    stage({"fluid", "--state", path("fluid.vti"), "--force", path("force.vti"), "--out", path("fluid.vti"),
           "--fields", path("flow.vti")});
  }
  EXPECT_TRUE(read_file(path("membrane.vtu")) == read_file(path("record/end/membrane.vtu")));
  EXPECT_TRUE(read_file(path("fluid.vti")) == read_file(path("record/end/fluid.vti")));
}

TEST_F(Energies, ThroughFilesAndWithOtherThreadsIsTheRun) {
  call({"run", path("case.toml"), "--output", path("memory"), "--set", "run.threads=1"});
  call({"run", path("case.toml"), "--output", path("files"), "--through-files"});
  call({"run", path("case.toml"), "--output", path("three"), "--set", "run.threads=3"});
  std::filesystem::remove_all(directory_ / "files" / "packets");
  EXPECT_EQ(result_files(directory_ / "memory"), result_files(directory_ / "files"));
  EXPECT_EQ(result_files(directory_ / "memory"), result_files(directory_ / "three"));
}

TEST_F(Energies, AreReplayedAndAnotherModulusIsSeen) {
  record(5);
  for (const char* component : {"membrane", "coupler", "fluid"})
    EXPECT_THAT(call({"replay", path("record"), "--only", component}), HasSubstr("identical: 15 steps"));
  EXPECT_THAT(call({"replay", path("record"), "--only", "membrane", "--set", "membrane.bending_modulus=0.01",
                    "--out", path("difference")}),
              AllOf(HasSubstr("node_force total_force"), Not(HasSubstr("identical"))));
}

TEST_F(Energies, ARunGoesOnToTheSameBits) {
  const std::vector<std::string> energy = {"--set", "output.energy_every=0.01"};
  const auto run = [&](const std::string& out, const char* shear_time) {
    std::vector<std::string> arguments = {"run",     path("case.toml"), "--output",
                                          path(out), "--shear-time",    shear_time};
    arguments.insert(arguments.end(), energy.begin(), energy.end());
    call(arguments);
  };
  run("whole", "0.04");
  run("half", "0.02");
  call({"run", "--resume", path("half"), "--shear-time", "0.04"});
  EXPECT_EQ(result_files(directory_ / "whole"), result_files(directory_ / "half"));
  EXPECT_TRUE(read_file(path("whole/energy.csv")) == read_file(path("half/energy.csv")));
  for (const char* file : {"fluid.vti", "membrane.vtu"}) {
    const auto place = std::filesystem::path("checkpoints/step_0000000020") / file;
    EXPECT_TRUE(read_file(directory_ / "whole" / place) == read_file(directory_ / "half" / place)) << file;
  }
  // Another modulus is another run.
  EXPECT_THAT(
      call({"run", "--resume", path("half"), "--shear-time", "0.05", "--set", "membrane.volume_modulus=5"},
           2),
      HasSubstr("membrane.volume_modulus"));
}

// Of the first capsule, which is not viscous; of the second the total has a viscous part too. Both sums are
// of the same parts in another order: some 100 roundings of parts that are at most ten times the largest
// force.
TEST_F(Energies, TheForcesOfAFileAddUp) {
  call({"run", path("case.toml"), "--output", path("out")});
  const auto file = exchange::read_surface(path("out/membrane/membrane_0000000020.vtu"));
  const auto total = array(file, "total_force"), bending = array(file, "bending_force");
  auto sum = array(file, "elastic_force");
  for (const char* name : {"bending_force", "global_area_force", "local_area_force", "volume_force"}) {
    const auto part = array(file, name);
    EXPECT_GT(*std::ranges::max_element(part), 0) << name;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
  }
  constexpr std::size_t n_first = 3 * 162;  // 320 triangles
  const double largest = *std::ranges::max_element(total);
  double not_viscous = 0, viscous = 0, bent = 0;
  for (std::size_t k = 0; k < total.size(); ++k) {
    auto& difference = k < n_first ? not_viscous : viscous;
    difference = std::max(difference, std::abs(total[k] - sum[k]));
    if (k >= n_first) bent = std::max(bent, std::abs(bending[k]));
  }
  EXPECT_LT(not_viscous, 1000 * 2.3e-16 * largest);
  EXPECT_GT(viscous, 1e-3 * largest);
  EXPECT_EQ(bent, 0);
}

TEST_F(Energies, TheTableHasTheColumnsOfTheTermsOfTheCase) {
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.energy_every=0.02", "--set",
        "membrane.local_area_modulus=0"});
  std::istringstream table(read_file(path("out/energy.csv")));
  std::string header, row;
  std::getline(table, header);
  EXPECT_THAT(header, ::testing::EndsWith("kinetic_energy,remainder,bending_energy,bending_power,"
                                          "global_area_energy,global_area_power,volume_energy,volume_power"));
  std::getline(table, row);
  EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(header, ','));
}

/// A vesicle of 320 triangles, stretched by 1.2 : 1, relaxes towards the sphere.
constexpr const char* vesicle = R"([flow]
kind = "periodic"
box = [20, 20, 20]
shear_rate = 1e-3
[[capsule]]
radius = 5
position = [10, 10, 10]
mesh = { file = "spheroid.vtu" }
[membrane]
elastic_law = "none"
capillary_number = 0.05
local_area_modulus = 10
[run]
shear_time = 0.1
[output]
observables_every = 0.1
energy_every = 0.02
membrane_every = 0.1
)";

// 100 steps. What the membrane gives up is all that moves the fluid: the energy falls from row to row.
TEST_F(Energies, AVesicleRelaxes) {
  call({"mesh", "sphere", "--level", "2", "--radius", "5", path("sphere.vtu")});
  auto mesh = exchange::read_surface(path("sphere.vtu"));
  for (std::size_t k = 0; k < mesh.points.size(); k += 3) mesh.points[k] *= 1.2;
  exchange::write_surface(path("spheroid.vtu"), mesh);
  std::ofstream(path("vesicle.toml")) << vesicle;
  call({"run", path("vesicle.toml"), "--output", path("out")});

  std::istringstream table(read_file(path("out/energy.csv")));
  std::string line;
  std::getline(table, line);
  const auto names = cells_of(line);
  double last = 0;
  int n_rows = 0;
  while (std::getline(table, line)) {
    const auto row = cells_of(line);
    std::map<std::string, double> at;
    for (std::size_t k = 0; k < names.size(); ++k) at[names[k]] = std::stod(row[k]);
    EXPECT_EQ(at["elastic_energy"], 0);
    const double energy = at["bending_energy"] + at["local_area_energy"];
    if (n_rows++ > 0) {
      EXPECT_LT(energy, last) << line;
      EXPECT_LT(at["bending_power"], 0);
    }
    last = energy;
  }
  EXPECT_EQ(n_rows, 6);

  const auto file = exchange::read_surface(path("out/membrane/membrane_0000000100.vtu"));
  const auto total = array(file, "total_force"), bending = array(file, "bending_force"),
             area = array(file, "local_area_force");
  const double largest = *std::ranges::max_element(total);
  for (std::size_t k = 0; k < total.size(); ++k)
    EXPECT_NEAR(total[k], bending[k] + area[k], 1000 * 2.3e-16 * largest);
  EXPECT_THAT(array(file, "elastic_force"), ::testing::Each(0.0));
}

}  // namespace
}  // namespace tanktread::testing
