#include "driver/system/placement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tanktread::driver {
namespace {

/// The first and last period by which one box is moved along an axis to come within reach of another.
struct Periods {
  int first = 0, last = 0;
};

Periods periods_within(double within, double low, double high, double other_low, double other_high,
                       double length) {
  return {static_cast<int>(std::ceil((low - other_high - within) / length)),
          static_cast<int>(std::floor((high - other_low + within) / length))};
}

std::string position_text(const Eigen::Vector3d& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", place[0], place[1], place[2]);
}

/// "capsule.1.position = [5, 5, 5]: what is wrong".
std::string problem_text(const Case& the_case, std::size_t number, const Objection& objection) {
  const auto& capsule = the_case.capsules[number];
  const auto value = objection.path.ends_with("position")
                         ? fmt::format("[{}]", fmt::join(capsule.position, ", "))
                         : fmt::format("{}", capsule.radius);
  return fmt::format("{}: {} = {}: {}", the_case.file.string(), objection.path, value, objection.what);
}

/// Surfaces that touch are as near as rounding says.
constexpr double touching = 1e-9;

std::optional<Objection> overlap(const Case& the_case, const Placement& placement, std::size_t other,
                                 std::size_t number) {
  if (is_sphere(the_case.capsules[other]) && is_sphere(the_case.capsules[number])) return std::nullopt;
  const auto nearest = placement.nearest(number, other, touching);
  if (!nearest) return std::nullopt;
  const auto how = nearest->first_encloses    ? fmt::format("holds capsule {} inside it", other)
                   : nearest->second_encloses ? fmt::format("lies inside capsule {}", other)
                                              : fmt::format("overlaps capsule {}", other);
  return Objection{
      fmt::format("capsule.{}.position", number),
      fmt::format("{}{}: their surfaces {} {}; move one of them, or make one smaller", how,
                  nearest->faces.isZero() ? "" : " across a periodic face",
                  nearest->first_encloses || nearest->second_encloses ? "are nearest about" : "meet about",
                  position_text(nearest->place))};
}

void refuse(const Case& the_case, const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  if (problems.size() == 1) throw InputError(problems.front());
  throw InputError(fmt::format("{}: {} problems\n  {}", the_case.file.string(), problems.size(),
                               fmt::join(problems, "\n  ")));
}

}  // namespace

Placement::Placement(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes)
    : the_case_(the_case) {
  for (const auto& mesh : meshes) {
    auto surface = std::make_shared<const membrane::PlacedSurface>(mesh);
    boxes_.push_back(surface->box());
    surfaces_.emplace(surfaces_.size(), std::move(surface));
  }
}

Placement::Placement(const Case& the_case, std::vector<Eigen::AlignedBox3d> boxes, MeshOf mesh_of)
    : the_case_(the_case), boxes_(std::move(boxes)), mesh_of_(std::move(mesh_of)) {}

Placement::Surface Placement::surface(std::size_t capsule) const {
  constexpr std::size_t most_held = 64;
  if (const auto found = surfaces_.find(capsule); found != surfaces_.end()) return found->second;
  if (surfaces_.size() >= most_held) surfaces_.clear();
  return surfaces_[capsule] = std::make_shared<const membrane::PlacedSurface>(mesh_of_(capsule));
}

Extent Placement::extent(std::size_t capsule, int axis) const {
  const auto& box = boxes_[capsule];
  const double at = the_case_.capsules[capsule].position[axis];
  return {at - box.min()[axis], box.max()[axis] - at};
}

std::optional<Nearest> Placement::nearest_at(std::size_t first, std::size_t second,
                                             const Eigen::Vector3i& faces, double within) const {
  const auto& box = the_case_.flow.box;
  const Eigen::Vector3d shift(faces[0] * box[0], faces[1] * box[1], faces[2] * box[2]);
  // Most are far apart, which their boxes tell; where one lies inside another these overlap.
  auto moved = boxes_[second];
  if (boxes_[first].exteriorDistance(moved.translate(shift)) > within) return std::nullopt;
  const auto one_held = surface(first), other_held = surface(second);
  const auto &one = *one_held, &other = *other_held;
  // What lies inside is no neighbour, however far it is from the surface around it.
  const bool holds = one.encloses(other, shift), is_held = other.encloses(one, -shift);
  const double far = std::numeric_limits<double>::infinity();
  const auto found = one.nearest_to(other, shift, holds || is_held ? far : within);
  if (!found) return std::nullopt;
  const bool is_apart = found->distance >= touching;
  return Nearest{found->distance, found->place, faces, is_apart && holds, is_apart && is_held};
}

std::optional<Nearest> Placement::nearest(std::size_t first, std::size_t second, double within) const {
  std::array<Periods, 3> periods;
  for (int axis = 0; axis < 3; ++axis) {
    const auto &one = boxes_[first], &other = boxes_[second];
    if (has_walls(the_case_, axis)) continue;
    periods[axis] = periods_within(within, one.min()[axis], one.max()[axis], other.min()[axis],
                                   other.max()[axis], the_case_.flow.box[axis]);
  }
  std::optional<Nearest> nearest;
  for (int z = periods[2].first; z <= periods[2].last; ++z) {
    for (int y = periods[1].first; y <= periods[1].last; ++y) {
      for (int x = periods[0].first; x <= periods[0].last; ++x) {
        const auto found = nearest_at(first, second, {x, y, z}, within);
        if (found && (!nearest || found->distance < nearest->distance)) nearest = found;
      }
    }
  }
  return nearest;
}

std::vector<OwnImage> Placement::images(std::size_t capsule, double within) const {
  std::map<std::string, double> distances;  // by the axes
  for (int number = 14; number < 27;
       ++number) {  // of the 26 neighbours of a box, one of each two opposite ones
    const Eigen::Vector3i faces(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
    std::string axes;
    bool is_periodic = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (faces[axis] == 0) continue;
      is_periodic = is_periodic && !has_walls(the_case_, axis);
      axes += "xyz"[axis];
    }
    if (!is_periodic) continue;
    const auto found = nearest_at(capsule, capsule, faces, within);
    if (!found) continue;
    const auto [entry, is_new] = distances.try_emplace(axes, found->distance);
    if (!is_new) entry->second = std::min(entry->second, found->distance);
  }
  std::vector<OwnImage> images;
  for (const auto& [axes, distance] : distances) {
    const bool is_nearest =
        std::ranges::all_of(distances, [&, near = distance, &own = axes](const auto& other) {
          return other.first.size() >= own.size() || near < other.second;
        });
    if (is_nearest) images.push_back({distance, fmt::format("{}", fmt::join(axes, " and "))});
  }
  return images;
}

void check_placement(const Case& the_case, const std::vector<membrane::TriangleMesh>& meshes) {
  check_placement(the_case, Placement(the_case, meshes));
}

void check_placement(const Case& the_case, const Placement& placement) {
  std::vector<std::string> problems;
  const auto note = [&](std::size_t number, const std::optional<Objection>& objection) {
    if (objection) problems.push_back(problem_text(the_case, number, *objection));
  };
  for (std::size_t k = 0; k < placement.size(); ++k) {
    for (int axis = 0; axis < 3 && !is_sphere(the_case.capsules[k]); ++axis)
      note(k, objection_along(the_case, k, axis, placement.extent(k, axis)));
    for (std::size_t other = 0; other < k; ++other) note(k, overlap(the_case, placement, other, k));
  }
  refuse(the_case, problems);
}

}  // namespace tanktread::driver
