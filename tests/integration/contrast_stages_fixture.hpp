// Two capsules with fluids of their own, one thicker and one thinner than that outside, for the program.
#pragma once

#include <fstream>
#include <string>

#include "exchange/vtk_files.hpp"
#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {

/// The thicker one has an implicit membrane viscosity too. The fluid moves from the first step on, so that
/// nodes of the grid come into the capsules and go out. 250 steps a shear time: 12 steps.
inline constexpr const char* contrast_staged_case = R"([[capsule]]
radius = 3.5
position = [6.5, 8.0, 9.0]
viscosity_ratio = 5.0
mesh = { level = 1 }
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 5.0 } }
[[capsule]]
radius = 3.0
position = [18.5, 8.0, 9.5]
viscosity_ratio = 0.5
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
[run]
shear_time = 0.048
checkpoint_every = 0.02
[output]
observables_every = 0.004
membrane_every = 0.008
fluid_every = 0.024
[flow]
box = [26, 16, 18]
wall_speed = 0.036
start = "developed"
)";
inline constexpr int contrast_steps = 12;
inline constexpr std::size_t contrast_nodes = 26 * 16 * 18;

/// The same with one viscosity.
inline const std::vector<std::string> no_contrast = {"--set", "capsule.0.viscosity_ratio=1", "--set",
                                                     "capsule.1.viscosity_ratio=1"};

class Contrast : public Stages {
 protected:
  void SetUp() override { write("storage = \"single\"\n", plain_coupler); }
  void write(const std::string& more_of_flow, const std::string& coupler) const {
    std::ofstream(path("case.toml")) << contrast_staged_case << more_of_flow << coupler;
  }
  /// The default kernel, with the tangential correction; volumes that are kept; a fluid in double precision.
  void correct() const { write("", "[coupler]\nkeep_volume = true\n"); }
  std::string checkpoint(const std::string& run, const std::string& file, int step = contrast_steps) const {
    return path(run + "/checkpoints/" + numbered("step", step) + "/" + file);
  }
  /// "inside_0000000007"
  static std::string numbered(const std::string& name, int step) {
    const auto digits = std::to_string(step);
    return name + "_" + std::string(10 - digits.size(), '0') + digits;
  }
  /// An array of a grid file.
  static std::vector<double> values(const std::string& file, const char* array) {
    return exchange::find_array(exchange::read_grid(file).point_data, array, file).values;
  }
  static bool has(const std::string& file, const char* array) {
    return exchange::find_optional_array(exchange::read_grid(file).point_data, array) != nullptr;
  }
  /// Both files of a state, byte for byte.
  void expect_same_end(const std::string& first, const std::string& second, int step = contrast_steps) const {
    for (const char* file : {"fluid.vti", "membrane.vtu"})
      EXPECT_TRUE(read_file(checkpoint(first, file, step)) == read_file(checkpoint(second, file, step)))
          << file;
  }
};

}  // namespace tanktread::testing
