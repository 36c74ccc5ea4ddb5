// Membranes from files: what every command that makes them says before it writes anything.
#include "driver/packets/surface_mesh.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/mesh.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* discs_case = R"([flow]
box = [60, 24, 20]
wall_speed = 0.02
[[capsule]]
radius = 5
position = [15, 6, 10]
mesh = { file = "disc.vtu" }
[[capsule]]
radius = 5
position = [36, 6, 10]
mesh = { file = "disc.vtu" }
[membrane]
capillary_number = 0.3
[run]
shear_time = 0.01
)";

class CellsFromFiles : public Stages {
 protected:
  void SetUp() override {
    std::ofstream(path("case.toml")) << discs_case;
    // Semi-axes 10, 5 and 2.5 when it has the volume of a sphere of radius 5.
    auto disc = membrane::icosphere(2, 1);
    disc.points = Eigen::Vector3d(2, 1, 0.5).asDiagonal() * disc.points;
    exchange::write_surface(path("disc.vtu"), driver::surface_packet(disc));
  }
  /// Every command that makes all membranes, on the case with this assignment; and that they leave no file.
  void expect_all(const std::string& assignment, int exit_code, const std::string& words) const {
    const std::vector<std::vector<std::string>> commands = {
        {"plan", path("case.toml")},
        {"run", path("case.toml"), "--output", path("out")},
        {"membrane", "--case", path("case.toml"), "--out", path("rest.vtu")},
        {"membrane", "--case", path("case.toml"), "--motion", "twist", "--shear-time", "0.01", "--out",
         path("twist")}};
    for (auto command : commands) {
      command.insert(command.end(), {"--set", assignment});
      EXPECT_THAT(call(command, exit_code), HasSubstr(words)) << command[0];
    }
    for (const char* output : {"out", "rest.vtu", "twist"})
      EXPECT_EQ(std::filesystem::exists(path(output)), exit_code == 0) << output;
  }
};

TEST_F(CellsFromFiles, ThatCutThroughEachOtherAreRefusedByEveryCommand) {
  expect_all("capsule.1.position.0=34", 2, "overlaps capsule 0: their surfaces meet about (24.");
}

TEST_F(CellsFromFiles, ThatAreLongerThanTheBoxAreRefusedByEveryCommand) {
  expect_all("flow.box.1=10", 2, "grid steps long, but its own periodic image only 10 away along y");
}

TEST_F(CellsFromFiles, ThatHaveRoomAreRunByEveryCommand) {
  expect_all("title=discs", 0, "");
}

}  // namespace
}  // namespace tanktread::testing
