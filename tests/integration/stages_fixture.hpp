// Two capsules, one of them viscous, recorded for a few steps by the program.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/integration/program.hpp"

namespace tanktread::testing {

inline constexpr const char* staged_case = R"([flow]
box = [26, 18, 20]
wall_speed = 0.02
[[capsule]]
radius = 3.5
position = [6.5, 9.0, 10.0]
mesh = { level = 2 }
[[capsule]]
radius = 3.0
position = [18.0, 9.0, 10.5]
mesh = { level = 1 }
[capsule.membrane]
capillary_number = 0.1
viscous = { scheme = "int2", boussinesq_shear = 1.0, spring_stiffness = 30.0, interval = 3, strain_sampling = "moving-average" }
[membrane]
capillary_number = 0.3
[run]
shear_time = 0.04
[output]
observables_every = 0.002
membrane_every = 0.004
)";  // 500 steps a shear time: 20 steps

/// A kernel that has no tangential correction unless a case asks for it: fewer packets are needed.
inline constexpr const char* plain_coupler = "[coupler]\nkernel = \"cosine4\"\n";

class Stages : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(path("case.toml")) << staged_case << plain_coupler; }

  /// Gives the case all that changes the velocity of nodes: the default kernel, with the tangential correction,
  /// and volumes that are kept.
  void correct() const {
    std::ofstream(path("case.toml")) << staged_case << "[coupler]\nkeep_volume = true\n";
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  /// Runs a command with the case. @return what it prints; a failure unless it ends with `exit_code`
  std::string call(std::vector<std::string> arguments, int exit_code = 0) const {
    const auto ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, exit_code) << ::testing::PrintToString(arguments) << "\n" << ended.output;
    return ended.output;
  }
  /// A stage of the case.
  std::string stage(std::vector<std::string> arguments, int exit_code = 0) const {
    arguments.insert(arguments.end(), {"--case", path("case.toml")});
    return call(arguments, exit_code);
  }
  /// The run, its steps from `from` on recorded in "record".
  void record(int from = 0) const {
    call({"run", path("case.toml"), "--output", path("out"), "--record", path("record"), "--from",
          std::to_string(from)});
  }

  const TemporaryDirectory directory_;
};

/// With the default kernel, which has the tangential correction, and with one that has not.
class CorrectedOrNot : public Stages, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    Stages::SetUp();
    if (GetParam()) correct();
  }
};
inline std::string name_of_correction(const ::testing::TestParamInfo<bool>& tested) {
  return tested.param ? "Corrected" : "Plain";
}

}  // namespace tanktread::testing
