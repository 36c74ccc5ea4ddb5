// What counts as empty, and what a killed process left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "driver/program/errors.hpp"
#include "driver/program/output_directory.hpp"
#include "exchange/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

class OutputDirectory : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(place_); }

  /// Half a file, as a process leaves it that is killed while it writes. @return its name
  fs::path half_written(const fs::path& target) const {
    fs::create_directories(target.parent_path());
    fs::path name;
    {
      const exchange::AtomicFile file(target);
      name = file.temporary();
    }  // which removes nothing: nothing is there yet
    std::ofstream(name) << "half";
    return name;
  }

  void hold(const std::string& file) const { std::ofstream(place_ / file) << "something"; }

  testing::TemporaryDirectory folder_;
  fs::path place_ = folder_ / "out";
};

TEST_F(OutputDirectory, IsEmptyWhereOnlyAKilledProcessWas) {
  hold(".lock");
  half_written(place_ / "echo.toml");
  EXPECT_NO_THROW(check_output_directory(place_, false));
  EXPECT_NO_THROW(require_new_directory("--record", place_));
}

TEST_F(OutputDirectory, IsNotEmptyWhereAnyOtherFileIs) {
  for (const char* file : {"thesis.txt", ".hidden", ".notes.tmp", ".echo.toml.tmp", ".step_one.tmp"}) {
    fs::remove_all(place_);
    fs::create_directories(place_);
    hold(file);
    EXPECT_THROW(check_output_directory(place_, false), InputError) << file;
    EXPECT_THROW(check_output_directory(place_, true), InputError) << file;
  }
}

TEST_F(OutputDirectory, IsRidOfWhatAKilledProcessLeftWhereverItWasAtWork) {
  hold(".notes.tmp");
  hold("echo.toml");
  const auto half_state = place_ / "checkpoints/.step_0000000012.tmp";
  half_written(half_state / "fluid.vti");
  const auto left = {half_written(place_ / "membrane.pvd"), half_written(place_ / "packets/node_force.vtu"),
                     half_state};
  for (const auto& path : left) ASSERT_TRUE(fs::exists(path)) << path;
  remove_temporary_files(place_);
  for (const auto& path : left) EXPECT_FALSE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::exists(place_ / ".notes.tmp"));
  EXPECT_TRUE(fs::exists(place_ / "echo.toml"));
}

}  // namespace
}  // namespace tanktread::driver
