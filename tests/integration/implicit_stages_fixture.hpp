// Three capsules, two of them with an implicit viscosity, for the program.
#pragma once

#include <fstream>
#include <string>

#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {

/// Without a spring; elastic; with a spring and rates by elements. 500 steps a shear time: 12 steps.
inline constexpr const char* implicit_staged_case = R"([flow]
box = [30, 16, 18]
wall_speed = 0.018
[[capsule]]
radius = 3.5
position = [5.0, 8.0, 9.0]
mesh = { level = 1 }
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 5.0 } }
[[capsule]]
radius = 3.0
position = [13.0, 8.0, 9.5]
mesh = { level = 1 }
[[capsule]]
radius = 4.0
position = [22.0, 8.0, 8.8]
mesh = { level = 1 }
membrane = { viscous = { scheme = "implicit", boussinesq_shear = 1.0, boussinesq_dilatational = 20.0, spring_stiffness = 200.0, strain_rates = "elements" } }
[membrane]
capillary_number = 0.3
[run]
shear_time = 0.024
checkpoint_every = 0.01
[output]
observables_every = 0.002
membrane_every = 0.004
)";

class Implicit : public Stages {
 protected:
  void SetUp() override { write(plain_coupler); }
  void write(const std::string& coupler) const {
    std::ofstream(path("case.toml")) << implicit_staged_case << coupler;
  }
  void correct() const { write("[coupler]\nkeep_volume = true\n"); }
};

}  // namespace tanktread::testing
