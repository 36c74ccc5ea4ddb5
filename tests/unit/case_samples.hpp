// Cases for the tests of the case file, its units and its echo.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"

namespace tanktread::testing {

/// A capsule in shear flow; no key more than is needed.
inline const std::string least_case = R"([flow]
box = [36, 40, 44]
reynolds_number = 0.1
[[capsule]]
radius = 6.0
position = [18.0, 20.0, 22.0]
[membrane]
capillary_number = 0.3
)";

/// Two capsules of different laws and sizes, no default left as it is.
inline const std::string full_case = R"(title = "Two \"capsules\"\n\ttouch \\ go"
[flow]
kind = "poiseuille"
box = [40, 50, 60]
wall_axis = "y"
flow_axis = "z"
wall_speed = 0.0123456789012345678
relaxation_time = 0.8
collision = "trt"
magic_parameter = 0.25
start = "developed"
body_force = [1e-7, 0, -2e-9]
inertia = false
storage = "single"
speed_limit = 0.2
[[capsule]]
radius = 5.1
position = [10.1, 25.2, 30.3]
mesh = { level = 4 }
[[capsule]]
radius = 7
position = [30.0, 25.0, 30.0]
membrane = { elastic_law = "hookean", poisson_ratio = 0.3, capillary_modulus = "G_s" }
[membrane]
elastic_law = "skalak"
capillary_number = 0.1
capillary_modulus = "E_s"
area_ratio = 10.5
[coupler]
kernel = "roma3"
keep_volume = true
tangential_correction = true
[run]
shear_time = 3.3
threads = 2
checkpoint_every = 0.7
[output]
observables_every = 0.01
measures_every = 0.02
membrane_every = 0
fluid_every = 0.3
fluid_box = [[0, 39], [25, 25], [3, 17]]
)";

/// A droplet in a box without walls.
inline const std::string droplet_case = R"([flow]
kind = "periodic"
box = [32, 32, 32]
shear_rate = 1e-4
collision = "bgk"
[[capsule]]
radius = 6
position = [0, 32, 16]
[membrane]
elastic_law = "interfacial-tension"
capillary_number = 0.2
)";

/// Physical values of two red-cell-sized capsules, the second half as large.
inline const std::string si_case = R"([flow]
box = [60, 60, 60]
[[capsule]]
radius = 8
position = [15, 30, 30]
[[capsule]]
radius = 4
position = [45, 30, 30]
[si]
radius_m = 4e-6
shear_rate_per_s = 1000
viscosity_Pa_s = 1.2e-3
density_kg_per_m3 = 1050
shear_modulus_N_per_m = 5.3e-6
)";

inline driver::Case parse(const std::string& text, const std::vector<std::string>& assignments = {}) {
  return driver::parse_case(text, "case.toml", "/somewhere", assignments);
}

/// The message with which a case is refused, or "" if it is not.
inline std::string refusal(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    parse(text, assignments);
  } catch (const driver::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace tanktread::testing
