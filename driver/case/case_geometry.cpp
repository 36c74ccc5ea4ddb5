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

/// Limits as a user would write them, to three decimals, on the side that is allowed.
double rounded_up(double limit) {
  return std::ceil(1000 * limit) / 1000;
}
double rounded_down(double limit) {
  return std::floor(1000 * limit) / 1000;
}

/// The first kernel of the list that reaches no further than `room`, as a fix; "" if none does.
std::string narrower_kernel(double room) {
  for (const auto& name : kernel_names()) {
    const auto reach = kernel_half_width(name);
    if (reach && *reach <= room)
      return fmt::format("; or coupler.kernel = \"{}\", which reaches {:g}", name, *reach);
  }
  return "";
}

std::string room_at_walls(const CapsuleCase& capsule, int axis, const Extent& extent, double reach,
                          double length) {
  const double long_by = extent.below + extent.above, room = length - 2 * reach;
  const double lowest = rounded_up(extent.below + reach),
               highest = rounded_down(length - extent.above - reach);
  if (lowest <= highest) return fmt::format("{} must be from {:.9g} to {:.9g}", "xyz"[axis], lowest, highest);
  const double largest = rounded_down(capsule.radius * room / long_by);
  return fmt::format("flow.box along {} must be at least {:.0f}{}, and the capsule midway between the walls",
                     "xyz"[axis], std::ceil(long_by + 2 * reach),
                     largest > 0 ? fmt::format(", or the radius at most {:.9g}", largest) : "");
}

std::optional<Objection> wall_objection(const Case& the_case, std::size_t number, int axis,
                                        const Extent& extent) {
  const auto& capsule = the_case.capsules[number];
  const auto& kernel = the_case.coupler.kernel;
  const auto reach = kernel_half_width(kernel);
  const double length = the_case.flow.box[axis];
  const double gap = gap_to_walls(the_case, capsule, axis, extent);
  if (!reach || gap >= *reach) return std::nullopt;
  return Objection{
      position_path(number),
      fmt::format("leaves {:.6g} grid steps between capsule and wall, but the kernel {} reaches {:g} "
                  "from the membrane and has no correction at a wall; {}{}",
                  gap, kernel, *reach, room_at_walls(capsule, axis, extent, *reach, length),
                  narrower_kernel(std::min(gap, 0.5 * *std::ranges::min_element(the_case.flow.box))))};
}

std::optional<Objection> image_objection(const Case& the_case, std::size_t number, int axis,
                                         const Extent& extent) {
  const double length = the_case.flow.box[axis], long_by = extent.below + extent.above;
  if (long_by < length) return std::nullopt;
  return Objection{
      fmt::format("capsule.{}.radius", number),
      fmt::format(
          "the capsule is {:.6g} grid steps long, but its own periodic image only {:g} away along {}; "
          "make the radius less than {:.9g}, or flow.box longer",
          long_by, length, "xyz"[axis], rounded_down(the_case.capsules[number].radius * length / long_by))};
}

/// Two nodes of one stencil must not be the same node of a periodic axis.
void check_width(CaseReader& reader, const Case& the_case) {
  const auto reach = kernel_half_width(the_case.coupler.kernel);
  const auto& box = the_case.flow.box;
  const auto shortest = std::ranges::min_element(box);
  if (!reach || the_case.capsules.empty() || *shortest >= std::ceil(2 * *reach)) return;
  reader.problem(
      "flow.box",
      fmt::format("has {} nodes along {}, but the kernel {} is {:.0f} wide; make it at least that{}",
                  *shortest, "xyz"[shortest - box.begin()], the_case.coupler.kernel, std::ceil(2 * *reach),
                  narrower_kernel(0.5 * *shortest)));
}

void check_place(CaseReader& reader, std::size_t number, const Case& the_case) {
  const auto& capsule = the_case.capsules[number];
  for (int axis = 0; axis < 3; ++axis) {
    const double length = the_case.flow.box[axis], at = capsule.position[axis];
    if (!(at >= 0 && at <= length)) {
      reader.problem(position_path(number),
                     fmt::format("lies outside the box; {} must be from 0 to {:g}", "xyz"[axis], length));
    } else if (is_sphere(capsule)) {
      const auto objection = objection_along(the_case, number, axis, extent_of_sphere(capsule));
      if (objection) reader.problem(objection->path, objection->what);
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
  return capsule.mesh.file.empty() && capsule.mesh.shape == "sphere";
}

bool has_own_stress_free_shape(const CapsuleCase& capsule) {
  return !capsule.stress_free.file.empty() || capsule.stress_free.shape != "mesh";
}

Extent extent_of_sphere(const CapsuleCase& capsule) {
  return {capsule.radius, capsule.radius};
}

double gap_to_walls(const Case& the_case, const CapsuleCase& capsule, int axis, const Extent& extent) {
  const double at = capsule.position[axis];
  return std::min(at - extent.below, the_case.flow.box[axis] - at - extent.above);
}

std::optional<Objection> objection_along(const Case& the_case, std::size_t number, int axis,
                                         const Extent& extent) {
  return has_walls(the_case, axis) ? wall_objection(the_case, number, axis, extent)
                                   : image_objection(the_case, number, axis, extent);
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
  check_width(reader, the_case);
  check_fluid_box(reader, the_case);
}

}  // namespace tanktread::driver
