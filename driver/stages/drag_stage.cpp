#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "driver/packets/packet_files.hpp"
#include "driver/program/output_directory.hpp"
#include "driver/program/signals.hpp"
#include "driver/stages/drag_motion.hpp"
#include "driver/stages/drag_output.hpp"
#include "driver/stages/stage_errors.hpp"
#include "driver/stages/stages.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/phases.hpp"
#include "driver/units/laws.hpp"
#include "driver/units/load_units.hpp"
#include "driver/units/schedule.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// A step is stable below 2 over the highest rate, which changes while a membrane is deformed.
constexpr double steps_in_highest_rate = 0.5;
/// Of a mean edge, that a node may move in a step at the speed it has.
constexpr double longest_step_in_edges = 0.1;

bool is_explicit(const CapsuleParameters& capsule) {
  return capsule.viscous && !is_implicit(*capsule.viscous);
}

void require_own_laws(const DragStage& stage, const Parameters& numbers) {
  const auto file = stage.the_case.file.string();
  for (std::size_t k = 0; k < numbers.capsules.size(); ++k) {
    const auto& membrane = stage.the_case.capsules[k].membrane;
    const auto& viscous = numbers.capsules[k].viscous;
    if (!membrane.command.empty()) {
      throw InputError(fmt::format(
          "{}: capsule {} has membrane.command, a program, whose stiffness is not known; a drag needs the "
          "laws of the program tanktread: --set membrane.command=[]",
          file, k));
    }
    if (viscous && is_implicit(*viscous) && (viscous->shear_spring > 0 || viscous->dilatational_spring > 0)) {
      throw InputError(fmt::format(
          "{}: capsule {} has an implicit viscosity with a spring; with a drag it has none: remove "
          "membrane.viscous.spring_..., or use an explicit scheme, \"fd\"",
          file, k));
    }
    if (is_explicit(numbers.capsules[k]) && !stage.in.empty()) {
      throw InputError(fmt::format(
          "--in {}: capsule {} has the viscous scheme \"{}\", which remembers strains from the start of the "
          "case on; leave out --in, or use the scheme \"implicit\" or \"none\"",
          stage.in.string(), k, membrane.viscous.scheme));
    }
  }
}

NodeVectors start_positions(const DragStage& stage, const std::vector<CapsuleMembrane>& membranes) {
  if (stage.in.empty()) return positions_of(membranes);
  const auto file = exchange::read_surface(stage.in);
  auto surfaces = surfaces_of(file, stage.in.string());
  check_surfaces(surfaces, membranes, stage.in.string());
  check_references(file, membranes, stage.in.string());
  return std::move(surfaces.positions);
}

/// The steps of the case at which something happens; loads that end before the end.
struct Events {
  Schedule rows, files;
  std::vector<std::int64_t> load_ends;
  std::int64_t end = 0;

  std::int64_t after(std::int64_t step) const {
    std::int64_t next = end;
    for (const auto& schedule : {rows, files})
      if (schedule.interval > 0) next = std::min(next, (step / schedule.interval + 1) * schedule.interval);
    for (const auto load_end : load_ends)
      if (load_end > step) next = std::min(next, load_end);
    return next;
  }
  bool has_load_end_after(std::int64_t step) const {
    return std::ranges::any_of(load_ends, [&](std::int64_t load_end) { return load_end > step; });
  }
};

Events events_of(const DragStage& stage, const Parameters& numbers) {
  Events events{schedule_of(stage.the_case.output.observables_every, numbers),
                schedule_of(stage.the_case.output.membrane_every, numbers),
                {},
                stage.shear_time > 0 ? steps_of(stage.shear_time, numbers, "--shear-time")
                                     : last_step_of(stage.the_case, numbers)};
  for (const auto& capsule : stage.the_case.capsules) {
    const auto end = load_end(capsule.load, numbers);
    if (capsule.load.force != 0 && end < events.end) events.load_ends.push_back(end);
  }
  return events;
}

/// How long steps are, time steps of the case.
class StepLength {
 public:
  StepLength(const DragStage& stage, const Parameters& numbers,
             const std::vector<membrane::TriangleMesh>& meshes)
      : given_(stage.step * numbers.steps_per_shear_time) {
    for (const auto& mesh : meshes) edges_.push_back(membrane::inspect(mesh).edge_mean);
  }

  /// The longest that is to be made from here.
  double longest(DragMotion& motion, std::int64_t step) const {
    if (given_ > 0) return given_;
    double length = steps_in_highest_rate / motion.highest_rate(step);
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const double speed = std::sqrt(motion.velocity()[k].colwise().squaredNorm().maxCoeff());
      if (speed > 0) length = std::min(length, longest_step_in_edges * edges_[k] / speed);
    }
    return length;
  }

 private:
  double given_;
  std::vector<double> edges_;
};

/// Equal steps, none longer than that, over a time.
std::int64_t n_steps_in(double time, double longest, double shear_rate) {
  const double n_steps = std::ceil(time / longest * (1 - 1e-12));
  if (n_steps <= static_cast<double>(most_steps)) return std::max<std::int64_t>(1, std::llround(n_steps));
  throw RunError(
      fmt::format("a step may be no longer than {:.3g} shear times, too short to get anywhere; a "
                  "larger drag (--drag) allows longer ones",
                  longest * shear_rate));
}

/// An explicit viscosity has the same steps throughout; they are whole parts of a time step of the case.
double law_step_of(const DragStage& stage, const Parameters& numbers, const MembraneShapes& shapes) {
  if (std::ranges::none_of(numbers.capsules, is_explicit)) return 1;
  DragMotion motion(stage.the_case, numbers, shapes, stage.drag, 1);
  motion.settle(positions_of(motion.membranes()), 0);
  const double longest = StepLength(stage, numbers, shapes.meshes).longest(motion, 0);
  return 1.0 / static_cast<double>(n_steps_in(1, longest, numbers.shear_rate));
}

void go_on(DragMotion& motion, std::int64_t from, std::int64_t to, std::int64_t n_steps) {
  const double dt = static_cast<double>(to - from) / static_cast<double>(n_steps);
  for (std::int64_t k = 1; k <= n_steps; ++k) motion.settle(motion.moved(dt), k < n_steps ? from : to);
}

[[noreturn]] void stop(const std::exception& error, std::int64_t step, double shear_rate) {
  throw RunError(fmt::format("after shear time {:g}: {}; make steps shorter with --step",
                             static_cast<double>(step) * shear_rate, error.what()));
}

void run(const DragStage& stage) {
  const auto numbers = parameters(stage.the_case);
  require_own_laws(stage, numbers);
  const auto shapes = membrane_shapes(stage.the_case);
  const auto& meshes = shapes.meshes;
  const auto events = events_of(stage, numbers);
  const double law_step = law_step_of(stage, numbers, shapes);
  const bool has_law_step = std::ranges::any_of(numbers.capsules, is_explicit);
  DragMotion motion(stage.the_case, numbers, shapes, stage.drag, law_step);
  const auto start = start_positions(stage, motion.membranes());
  require_new_directory("--out", stage.out);
  DragOutput output(stage.out, stage.the_case, numbers, meshes);
  const StepLength steps(stage, numbers, meshes);
  std::int64_t step = 0, n_steps_made = 0;
  try {
    if (!stage.in.empty()) motion.start_at(start);
    motion.settle(start, step);
    output.begin();
    output.add_row(motion, step);
    output.add_file(motion, step);
    while (step < events.end && SignalGuard::caught() == 0) {
      const auto next = events.after(step);
      const double longest = has_law_step ? law_step : steps.longest(motion, step);
      const auto n_steps = n_steps_in(static_cast<double>(next - step), longest, numbers.shear_rate);
      if (step == 0) {
        fmt::print("steps of {:.3g} shear times at first, {:.3g} of a time step of the case\n",
                   static_cast<double>(next) * numbers.shear_rate / static_cast<double>(n_steps),
                   static_cast<double>(next) / static_cast<double>(n_steps));
      }
      go_on(motion, step, next, n_steps);
      step = next;
      n_steps_made += n_steps;
      const bool is_still = output.speed(motion) <= stage.still && !events.has_load_end_after(step);
      const bool is_last = step == events.end || is_still;
      if (events.rows.due(step) || is_last) output.add_row(motion, step);
      if (events.files.due(step) || is_last) output.add_file(motion, step);
      if (!is_still) continue;
      fmt::print("stands still at shear time {:g}\n", static_cast<double>(step) * numbers.shear_rate);
      break;
    }
  } catch (const LongMove& error) {
    stop(error, step, numbers.shear_rate);
  } catch (const membrane::InvertedElement& error) {
    stop(error, step, numbers.shear_rate);
  }
  fmt::print("{} steps; largest speed at the end {:.3g} radii per shear time\n", n_steps_made,
             output.speed(motion));
}

}  // namespace

void run_stage(const DragStage& stage) {
  with_stage_errors<>([&] { run(stage); });
}

}  // namespace tanktread::driver
