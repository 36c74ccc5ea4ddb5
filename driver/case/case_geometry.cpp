#include "driver/case/case_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/case/case_checks.hpp"
#include "driver/case/names.hpp"

namespace tanktread::driver {
namespace {

std::string position_path(std::size_t number) {
  return fmt::format("capsule.{}.position", number);
}

void check_wall(CaseReader& reader, std::size_t number, const Case& the_case, int axis) {
  const auto& capsule = the_case.capsules[number];
  const auto& kernel = the_case.coupler.kernel;
  const auto reach = kernel_half_width(kernel);
  const double length = the_case.flow.box[axis];
  const double gap = gap_along(the_case, capsule, axis);
  if (!reach || gap >= *reach || !is_sphere(capsule)) return;
  const double least = capsule.radius + *reach;
  const auto fix =
      2 * least <= length
          ? fmt::format("{} must be from {:.6g} to {:.6g}", "xyz"[axis], least, length - least)
          : fmt::format("flow.box along {0} must be at least {1:.0f}, or the radius at most {2:.6g}",
                        "xyz"[axis], std::ceil(2 * least), length / 2 - *reach);
  reader.problem(
      position_path(number),
      fmt::format("leaves {:.6g} grid steps between capsule and wall, but the kernel {} reaches {:g} "
                  "from the membrane and has no correction at a wall; {}",
                  gap, kernel, *reach, fix));
}

void check_place(CaseReader& reader, std::size_t number, const Case& the_case) {
  const auto& capsule = the_case.capsules[number];
  for (int axis = 0; axis < 3; ++axis) {
    const double length = the_case.flow.box[axis], at = capsule.position[axis];
    if (!(at >= 0 && at <= length)) {
      reader.problem(position_path(number),
                     fmt::format("lies outside the box; {} must be from 0 to {:g}", "xyz"[axis], length));
    } else if (has_walls(the_case, axis)) {
      check_wall(reader, number, the_case, axis);
    } else if (2 * capsule.radius >= length && is_sphere(capsule)) {
      reader.problem(
          fmt::format("capsule.{}.radius", number),
          fmt::format("the capsule overlaps its own periodic image, {:g} grid steps away along {}; "
                      "make the radius less than {:g}, or flow.box longer",
                      length, "xyz"[axis], length / 2));
    }
  }
}

void check_overlaps(CaseReader& reader, const Case& the_case) {
  const auto& capsules = the_case.capsules;
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      const double distance = distance_between(the_case, capsules[i], capsules[k]);
      const double needed = capsules[i].radius + capsules[k].radius;
      if (distance >= needed || !is_sphere(capsules[i]) || !is_sphere(capsules[k])) continue;
      reader.problem(
          position_path(k),
          fmt::format("overlaps capsule {}: the centres are {:.6g} grid steps apart, the radii sum to "
                      "{:.6g}; move one of them, or make one smaller",
                      i, distance, needed));
    }
  }
}

void check_fluid_box(CaseReader& reader, const Case& the_case) {
  if (!the_case.output.fluid_box) return;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [first, last] = (*the_case.output.fluid_box)[axis];
    const int end = the_case.flow.box[axis] - 1;
    if (first <= last && last <= end) continue;
    reader.problem(
        "output.fluid_box",
        fmt::format("along {} it must be [first, last] with 0 <= first <= last <= {}", "xyz"[axis], end));
  }
}

}  // namespace

bool has_walls(const Case& the_case, int axis) {
  return the_case.flow.kind != "periodic" && axis == the_case.flow.wall_axis;
}

bool is_sphere(const CapsuleCase& capsule) {
  return capsule.mesh.file.empty();
}

double gap_along(const Case& the_case, const CapsuleCase& capsule, int axis) {
  const double length = the_case.flow.box[axis], at = capsule.position[axis];
  return has_walls(the_case, axis) ? std::min(at, length - at) - capsule.radius : length - 2 * capsule.radius;
}

double distance_between(const Case& the_case, const CapsuleCase& a, const CapsuleCase& b) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double along = a.position[axis] - b.position[axis];
    if (!has_walls(the_case, axis)) along = std::remainder(along, the_case.flow.box[axis]);
    squared += along * along;
  }
  return std::sqrt(squared);
}

void check_geometry(CaseReader& reader, const Case& the_case) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) check_place(reader, k, the_case);
  check_overlaps(reader, the_case);
  check_fluid_box(reader, the_case);
}

}  // namespace tanktread::driver
