#include "fluid/settings.hpp"

#include <cmath>
#include <sstream>

#include "fluid/border_checks.hpp"
#include "fluid/d3q19.hpp"

namespace tanktread::fluid {
namespace {

void require(bool fine, const std::string& setting, double value, const std::string& allowed) {
  if (fine) return;
  std::ostringstream message;
  message << setting << " is " << value << ", must be " << allowed;
  refuse(message.str());
}

void check_wall_velocity(const WallPair& walls, const std::array<double, 3>& velocity,
                         const std::string& name) {
  for (const double component : velocity) require(std::isfinite(component), name, component, "finite");
  require(velocity[walls.axis] == 0.0, name + " along the wall axis", velocity[walls.axis],
          "0 (a wall moves in its own plane)");
}

}  // namespace

void check(const LatticeBoltzmannSettings& settings) {
  const auto& shape = settings.shape;
  // Three nodes along x, so that one of them has both neighbours in its row (PopulationLattice::row_slot).
  require(shape.nx >= 3, "shape.nx", shape.nx, ">= 3");
  require(shape.ny >= 1, "shape.ny", shape.ny, ">= 1");
  require(shape.nz >= 1, "shape.nz", shape.nz, ">= 1");
  require(std::isfinite(settings.relaxation_time) && settings.relaxation_time > 0.5, "relaxation_time",
          settings.relaxation_time, "> 0.5 (a positive viscosity)");
  if (settings.magic_parameter) {
    require(std::isfinite(*settings.magic_parameter) && *settings.magic_parameter > 0.0, "magic_parameter",
            *settings.magic_parameter, "> 0");
  }
  require(settings.speed_limit > 0.0, "speed_limit", settings.speed_limit, "> 0");
  require(settings.threads >= 0, "threads", settings.threads, ">= 0 (0: all)");
  for (const double component : settings.body_force)
    require(std::isfinite(component), "body_force", component, "finite");
  if (settings.walls) {
    require(settings.walls->axis >= 0 && settings.walls->axis <= 2, "walls.axis", settings.walls->axis,
            "0, 1 or 2");
    check_wall_velocity(*settings.walls, settings.walls->low_velocity, "walls.low_velocity");
    check_wall_velocity(*settings.walls, settings.walls->high_velocity, "walls.high_velocity");
  } else if (settings.start == Start::developed) {
    refuse("start = developed needs walls: a periodic box has no developed profile");
  }
}

void check(const GridPart& part, const GridShape& box) {
  const std::array<const char*, 3> axis = {"x", "y", "z"};
  const std::array<int, 3> least = {3, 1, 1}, n = {part.shape.nx, part.shape.ny, part.shape.nz},
                           n_box = {box.nx, box.ny, box.nz};
  for (int k = 0; k < 3; ++k) {
    const std::string along = std::string(" along ") + axis[k];
    require(n[k] >= least[k] && n[k] <= n_box[k], "part.shape" + along, n[k],
            std::to_string(least[k]) + " to " + std::to_string(n_box[k]) + ", the nodes of the box");
    require(part.begin[k] >= 0 && part.begin[k] <= n_box[k] - n[k], "part.begin" + along, part.begin[k],
            "0 to " + std::to_string(n_box[k] - n[k]) + ", so that the part ends within the box");
  }
}

double viscosity_of(const LatticeBoltzmannSettings& settings) {
  return (settings.relaxation_time - 0.5) / d3q19::inverse_sound_speed_squared;
}

double odd_relaxation_time(const LatticeBoltzmannSettings& settings, double relaxation_time) {
  if (!settings.magic_parameter) return relaxation_time;
  return *settings.magic_parameter / (relaxation_time - 0.5) + 0.5;
}

}  // namespace tanktread::fluid
