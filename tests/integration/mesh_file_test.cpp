// A case whose cell is a file: what of a run still depends on that file afterwards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/packets/surface_mesh.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/integration/run_fixture.hpp"

namespace {

using namespace tanktread;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class MeshFile : public Run {
 protected:
  void SetUp() override {
    Run::SetUp();
    make_sphere("2");
    auto text = read_file(case_file_);
    const std::string shape = "{ shape = \"sphere\", level = 2 }";
    std::ofstream(case_file_) << text.replace(text.find(shape), shape.size(), "{ file = \"cell.vtu\" }");
  }
  void make_sphere(const std::string& level) const {
    ASSERT_EQ(run_program({"mesh", "sphere", "--level", level, "--radius", "3", cell_.string()}).exit_code,
              0);
  }
  std::string hash() const { return driver::geometry_hash(exchange::read_surface(cell_, true)); }
  std::vector<std::string> run_echo(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"run", (directory_ / "first/echo.toml").string(), "--output",
                                          (directory_ / "again").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void run_first() const {
    const auto ended = run_program(run_to("first", {"--shear-time", "0.1"}));
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
  }

  std::filesystem::path cell_ = directory_ / "cell.vtu";
};

TEST_F(MeshFile, IsNotAskedForWhenARunGoesOn) {
  ASSERT_EQ(run_program(run_to("whole", {"--shear-time", "0.2"})).exit_code, 0);
  for (const bool is_gone : {true, false}) {
    make_sphere("2");
    std::filesystem::remove_all(directory_ / "first");
    run_first();
    if (is_gone) {
      std::filesystem::remove(cell_);
    } else {
      make_sphere("1");
    }
    const auto ended =
        run_program({"run", "--resume", (directory_ / "first").string(), "--shear-time", "0.2"});
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
    expect_same_results("whole", "first");
  }
}

TEST_F(MeshFile, OfAnEchoIsTheOneThatItWasMadeWith) {
  run_first();
  const auto former = hash();
  EXPECT_THAT(read_file(directory_ / "first/echo.toml"), HasSubstr("mesh.file_hash = \"" + former + "\""));
  EXPECT_THAT(run_program({"mesh", "info", cell_.string()}).output, HasSubstr(former));
  ASSERT_EQ(run_program(run_echo()).exit_code, 0);
  expect_same_results("first", "again");
  std::filesystem::remove_all(directory_ / "again");
  make_sphere("1");
  const auto refused = run_program(run_echo());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("first/echo.toml"), HasSubstr("capsule.0.mesh.file_hash"),
                                    HasSubstr(cell_.string()), HasSubstr(former), HasSubstr(hash())));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "again"));
  // The fixes that it names: the new hash, or none.
  for (const auto& value : {hash(), std::string()}) {
    const auto meant = run_program(run_echo({"--set", "capsule.0.mesh.file_hash=" + value}));
    EXPECT_EQ(meant.exit_code, 0) << meant.output;
    EXPECT_THAT(read_file(directory_ / "again/echo.toml"), HasSubstr(hash()));
    std::filesystem::remove_all(directory_ / "again");
  }
}

TEST_F(MeshFile, ThatWasMovedIsFoundByItsNewName) {
  run_first();
  std::filesystem::rename(cell_, directory_ / "moved.vtu");
  const auto refused = run_program(run_echo());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("there is no file " + cell_.string()), HasSubstr("moved"),
                                    HasSubstr("mesh.file_hash")));
  const auto ended =
      run_program(run_echo({"--set", "capsule.0.mesh.file=" + (directory_ / "moved.vtu").string()}));
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
}

TEST_F(MeshFile, WrittenAnewWithOtherArraysIsTheSame) {
  run_first();
  const auto former = hash();
  auto packet = exchange::read_surface(cell_, true);
  packet.point_data.push_back({"height", 1, std::vector<double>(packet.points.size() / 3, 1.0)});
  exchange::write_surface(cell_, packet);
  EXPECT_EQ(hash(), former);
  EXPECT_EQ(run_program(run_echo()).exit_code, 0);
  packet.points[0] += 1e-12;
  exchange::write_surface(cell_, packet);
  EXPECT_NE(hash(), former);
}

TEST_F(MeshFile, IsNotAskedForByAStageThatDoesNotReadIt) {
  std::filesystem::remove(cell_);
  const auto fluid = run_program(
      {"fluid", "--case", case_file_.string(), "--steps", "1", "--out", (directory_ / "fluid.vti").string()});
  EXPECT_EQ(fluid.exit_code, 0) << fluid.output;
  const auto membrane = run_program(
      {"membrane", "--case", case_file_.string(), "--out", (directory_ / "membrane.vtu").string()});
  EXPECT_EQ(membrane.exit_code, 2);
  EXPECT_THAT(membrane.output, HasSubstr("there is no file " + cell_.string()));
}

TEST(MeshFileHash, WithoutAFileIsRefused) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "case.toml") << small_case;
  const auto ended = run_program(
      {"plan", (directory / "case.toml").string(), "--set", "capsule.0.mesh.file_hash=0123456789abcdef"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("is of the file beside it, which is not given"));
}

}  // namespace
