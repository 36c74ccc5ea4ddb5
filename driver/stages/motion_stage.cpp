#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "driver/packets/field_number.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/program/output_directory.hpp"
#include "driver/program/signals.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/study/twisting_sphere.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/schedule.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// A motion as a function of the time step, and the steps at which its results are written, ascending, from
/// 0.
struct Motion {
  std::function<NodeVectors(std::int64_t)> positions;
  std::vector<std::int64_t> written;
};

/// A folder of more is of no use, and the list of their steps is kept.
constexpr std::int64_t most_files = 1'000'000;

/// Every capsule twisted to and fro about the z axis through its place.
Motion twist(const MotionStage& stage, const Parameters& numbers,
             const std::vector<membrane::TriangleMesh>& meshes) {
  std::vector<TwistingSphere> spheres;
  for (const auto& capsule : stage.the_case.capsules) {
    TwistingSphere sphere;
    sphere.centre = {capsule.position[0], capsule.position[1], capsule.position[2]};
    sphere.radius = capsule.radius;
    sphere.amplitude = stage.twist_amplitude;
    sphere.period = stage.twist_period * numbers.steps_per_shear_time;
    spheres.push_back(sphere);
  }
  Motion motion;
  motion.positions = [spheres, meshes](std::int64_t step) {
    NodeVectors positions;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      positions.push_back(spheres[k].twisted(meshes[k].points, static_cast<double>(step)));
    }
    return positions;
  };
  const auto schedule = schedule_of(stage.every, numbers);
  const auto end = steps_of(stage.shear_time, numbers, "--shear-time");
  if (end / schedule.interval > most_files) {
    throw InputError(
        fmt::format("--every {:g}: makes {} files up to shear time {:g}, more than {}; make it longer",
                    stage.every, end / schedule.interval + 1, stage.shear_time, most_files));
  }
  for (std::int64_t step = 0; step < end; step += schedule.interval) motion.written.push_back(step);
  motion.written.push_back(end);
  return motion;
}

/// @throws InputError if a series names a file at another time than its own: which of the two is meant?
void require_own_time(const std::optional<double>& own, const exchange::SeriesEntry& entry,
                      const std::filesystem::path& series) {
  if (!own || *own == entry.time) return;
  throw InputError(
      fmt::format("{}: names {} at shear time {}, but the file is of shear time {}; name it at its own time",
                  series.string(), entry.file, entry.time, *own));
}

/// The surfaces of a .pvd, each at its time, counted from that of the first. Where a run names its last file
/// again, because its other series has a file then, there is no new surface.
Motion series(const MotionStage& stage, const Parameters& numbers,
              const std::vector<CapsuleMembrane>& membranes) {
  const auto entries = exchange::read_series(stage.series);
  if (entries.empty())
    throw InputError(stage.series.string() + ": holds no file; a motion needs at least one");
  std::vector<NodeVectors> frames;
  Motion motion;
  std::string last_file;
  std::optional<double> own;
  for (const auto& entry : entries) {
    if (own && entry.file == last_file) continue;
    last_file = entry.file;
    const auto file = stage.series.parent_path() / entry.file;
    const auto surface = exchange::read_surface(file);
    own = field_number(surface, "shear_time");
    require_own_time(own, entry, stage.series);
    auto surfaces = surfaces_of(surface, file.string());
    check_surfaces(surfaces, membranes, file.string());
    const auto step = steps_of(entry.time - entries.front().time, numbers,
                               fmt::format("{}: the time of {}", stage.series.string(), entry.file));
    if (!motion.written.empty() && step <= motion.written.back()) {
      throw InputError(
          fmt::format("{}: {} is at shear time {}, less than a time step after the file before it; a motion "
                      "goes forward",
                      stage.series.string(), entry.file, entry.time));
    }
    motion.written.push_back(step);
    frames.push_back(std::move(surfaces.positions));
  }
  motion.positions = [frames, steps = motion.written](std::int64_t step) {
    const auto next = static_cast<std::size_t>(std::ranges::lower_bound(steps, step) - steps.begin());
    if (steps[next] == step) return frames[next];
    const double part =
        static_cast<double>(step - steps[next - 1]) / static_cast<double>(steps[next] - steps[next - 1]);
    NodeVectors positions;
    for (std::size_t k = 0; k < frames[next].size(); ++k) {
      positions.emplace_back(frames[next - 1][k] + part * (frames[next][k] - frames[next - 1][k]));
    }
    return positions;
  };
  return motion;
}

/// Goes through the motion; the first positions are not a step of the membrane, whose history begins there.
void follow(const Motion& motion, std::vector<CapsuleMembrane>& membranes, const Parameters& numbers,
            const std::filesystem::path& out) {
  auto positions = motion.positions(0);
  auto velocity =
      zero_like(positions);  // of the first file: none is known, and the forces are without viscous ones
  NodeVectors force;
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    membranes[k].set_positions(positions[k]);
    force.push_back(membranes[k].elastic_forces());
    for (const auto& term : membranes[k].term_names()) force[k] += membranes[k].term_forces(term);
    membranes[k].add_load(0, force[k]);
  }
  std::filesystem::create_directories(out / "membrane");
  exchange::write_series(out / "membrane.pvd", {});
  auto due = motion.written.begin();
  for (std::int64_t step = 0;; ++step) {
    if (step > 0) {
      auto next = motion.positions(step);
      for (std::size_t k = 0; k < membranes.size(); ++k) velocity[k] = next[k] - positions[k];
      positions = std::move(next);
      force = nodal_forces(membranes, positions, velocity, step);
      add_viscous_forces_of(membranes, velocity, force);
    }
    if (step != *due) continue;
    const double shear_time = static_cast<double>(step) * numbers.shear_rate;
    const auto file = fmt::format("membrane/membrane_{:010}.vtu", step);
    exchange::write_surface(out / file, membrane_file(membranes, velocity, force, step, shear_time));
    exchange::append_to_series(out / "membrane.pvd", {shear_time, file});
    if (++due == motion.written.end() || SignalGuard::caught() != 0) return;
  }
}

/// A Maxwell element has no history but that of the shape which the case starts with: from elsewhere the
/// first step would be a jump.
void require_rest(const MotionStage& stage, const Parameters& numbers,
                  const std::vector<CapsuleMembrane>& membranes, const NodeVectors& start) {
  constexpr double rounding = 1e-6;
  for (std::size_t k = 0; k < membranes.size(); ++k) {
    const auto& viscous = numbers.capsules[k].viscous;
    if (!viscous || is_implicit(*viscous)) continue;
    membrane::Membrane from_start({membranes[k].start(), membranes[k].reference().triangles},
                                  elastic_law(stage.the_case.capsules[k].membrane, numbers.capsules[k]));
    from_start.set_positions(start[k]);
    const auto stretches = from_start.element_fields().principal_stretches;
    if ((stretches.array() - 1).abs().maxCoeff() < rounding) continue;
    throw InputError(fmt::format(
        "{}: capsule {} is deformed at the beginning; with a membrane viscosity a motion must begin "
        "with the shape that the case starts with",
        stage.series.string(), k));
  }
}

void run(const MotionStage& stage) {
  const auto numbers = parameters(stage.the_case);
  const auto shapes = membrane_shapes(stage.the_case);
  auto membranes = make_membranes(stage.the_case, numbers, shapes);
  const auto motion =
      stage.series.empty() ? twist(stage, numbers, shapes.meshes) : series(stage, numbers, membranes);
  require_new_directory("--out", stage.out);
  require_rest(stage, numbers, membranes, motion.positions(0));
  follow(motion, membranes, numbers, stage.out);
}

}  // namespace

void run_stage(const MotionStage& stage) {
  with_stage_errors<membrane::InvertedElement>([&] { run(stage); });
}

}  // namespace tanktread::driver
