// A small capsule in shear flow, run by the program in a directory of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <fstream>

#include "tests/integration/program.hpp"

namespace tanktread::testing {

/// 24^3 nodes, shear rate 2 * 0.02/24, so 600 steps a shear time.
inline constexpr const char* small_case = R"(
title = "Small capsule"
[flow]
kind = "shear"
box = [24, 24, 24]
wall_speed = 0.02
relaxation_time = 1.0
[[capsule]]
radius = 5.0
position = [12.0, 12.0, 12.0]
mesh = { shape = "sphere", level = 2 }
[membrane]
elastic_law = "skalak"
capillary_number = 0.3
[run]
shear_time = 1.0
checkpoint_every = 0.1
[output]
observables_every = 0.05
membrane_every = 0.25
fluid_every = 0.5
)";

class Run : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(case_file_) << small_case; }

  std::vector<std::string> run_to(const std::string& name, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"run", case_file_.string(), "--output",
                                          (directory_ / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  void expect_same_results(const std::string& first, const std::string& second) const {
    const auto a = result_files(directory_ / first), b = result_files(directory_ / second);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].first, b[k].first);
      EXPECT_TRUE(a[k].second == b[k].second) << a[k].first << " differs";
    }
  }

  bool has_checkpoint_after(const std::string& name, const std::string& step) const {
    const auto folder = directory_ / name / "checkpoints";
    if (!std::filesystem::is_directory(folder)) return false;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename().string() >= "step_" + step && entry.path().filename().string()[0] == 's')
        return true;
    }
    return false;
  }

  void expect_killed_run_goes_on(const std::vector<std::string>& more) const {
    ASSERT_EQ(run_program(run_to("whole", more)).exit_code, 0);
    const auto killed = run_and_signal(run_to("killed", more), SIGKILL,
                                       [&] { return has_checkpoint_after("killed", "0000000240"); });
    ASSERT_EQ(killed.exit_code, 128 + SIGKILL) << "the run ended before it was killed";
    const auto resumed = run_program({"run", "--resume", (directory_ / "killed").string()});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
    expect_same_results("whole", "killed");
  }

  TemporaryDirectory directory_;
  std::filesystem::path case_file_ = directory_ / "small.toml";
};

}  // namespace tanktread::testing
