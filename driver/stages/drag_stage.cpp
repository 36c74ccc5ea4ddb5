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
/// Of a mean edge, that a node may move in a step at the speed it has (so most folds pass SurfaceCheck before
/// they are closed).
constexpr double longest_step_in_edges = 0.1;
/// After so many steps their length is found anew. A trial costs about six steps. Steps stay stable while the
/// rate grows by less than four times; a stomatocyte's grew by half in some thousand.
constexpr std::int64_t steps_in_trial = 100;

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

  bool is_given() const { return given_ > 0; }
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

/// Forces and velocities at the start. @throws InputError if it is no surface to start from
void settle_start(DragMotion& motion, const NodeVectors& start, const DragStage& stage) {
  try {
    if (!stage.in.empty()) motion.start_at(start);
    motion.settle(start, 0);
  } catch (const membrane::InvertedElement& error) {
    throw InputError(
        fmt::format("{}: {}; start from another surface, {}",
                    stage.in.empty() ? stage.the_case.file.string() : "--in " + stage.in.string(),
                    error.what(), "--in or capsule.N.mesh, or one of more triangles"));
  }
}

/// An explicit viscosity has the same steps throughout; they are whole parts of a time step of the case. 0
/// without one.
double law_step_of(const DragStage& stage, const Parameters& numbers, const MembraneShapes& shapes) {
  if (std::ranges::none_of(numbers.capsules, is_explicit)) return 0;
  DragMotion motion(stage.the_case, numbers, shapes, stage.drag, 1);
  settle_start(motion, positions_of(motion.membranes()), stage);
  const double longest = StepLength(stage, numbers, shapes.meshes).longest(motion, 0);
  return 1.0 / static_cast<double>(n_steps_in(1, longest, numbers.shear_rate));
}

/// The time that a motion has come to, time steps of the case.
struct Progress {
  double time = 0;
  std::int64_t n_steps = 0;
};

/// From the present step of the case to another, by equal steps between two trials of their length.
/// @param law_step the length of all of them; 0: by trial
void go_on(DragMotion& motion, const StepLength& steps, double law_step, double shear_rate, std::int64_t to,
           Progress& progress) {
  const auto from = static_cast<std::int64_t>(progress.time);
  for (std::int64_t left = 1; left > 0;) {
    const double time = static_cast<double>(to) - progress.time;
    const bool has_one_length = law_step > 0 || steps.is_given();
    left = n_steps_in(time, law_step > 0 ? law_step : steps.longest(motion, from), shear_rate);
    if (progress.n_steps == 0) {
      fmt::print("steps of {:.3g} shear times at first, {:.3g} of a time step of the case\n",
                 time * shear_rate / static_cast<double>(left), time / static_cast<double>(left));
    }
    const double dt = time / static_cast<double>(left);
    const auto n_steps = has_one_length ? left : std::min(left, steps_in_trial);
    left -= n_steps;
    for (std::int64_t k = 1; k <= n_steps; ++k) {
      motion.settle(motion.moved(dt), left == 0 && k == n_steps ? to : from);
      progress.time += dt;
      ++progress.n_steps;
    }
  }
  progress.time = static_cast<double>(to);
}

/// @param advice what to do; may be empty
[[noreturn]] void stop(const std::exception& error, const std::string& advice, double shear_time,
                       const std::filesystem::path& last_good) {
  throw RunError(
      fmt::format("after shear time {:g}: {}{}{}{}", shear_time, error.what(), advice.empty() ? "" : "; ",
                  advice, last_good.empty() ? "" : "; the last state before it is in " + last_good.string()));
}

void run(const DragStage& stage) {
  const auto numbers = parameters(stage.the_case);
  require_own_laws(stage, numbers);
  const auto shapes = membrane_shapes(stage.the_case);
  const auto& meshes = shapes.meshes;
  const auto events = events_of(stage, numbers);
  const double law_step = law_step_of(stage, numbers, shapes);
  DragMotion motion(stage.the_case, numbers, shapes, stage.drag, law_step > 0 ? law_step : 1);
  const auto start = start_positions(stage, motion.membranes());
  settle_start(motion, start, stage);
  require_new_directory("--out", stage.out);
  DragOutput output(stage.out, stage.the_case, numbers, meshes);
  const StepLength steps(stage, numbers, meshes);
  std::int64_t step = 0;
  Progress progress;
  try {
    output.begin();
    output.add_row(motion, step);
    output.add_file(motion, step);
    output.remember(motion, step);
    while (step < events.end && SignalGuard::caught() == 0) {
      step = events.after(step);
      go_on(motion, steps, law_step, numbers.shear_rate, step, progress);
      const bool is_still = output.speed(motion) <= stage.still && !events.has_load_end_after(step);
      const bool is_last = step == events.end || is_still;
      if (events.rows.due(step) || is_last) output.add_row(motion, step);
      if (events.files.due(step) || is_last) output.add_file(motion, step);
      output.remember(motion, step);
      if (!is_still) continue;
      fmt::print("stands still at shear time {:g}\n", static_cast<double>(step) * numbers.shear_rate);
      break;
    }
  } catch (const LongMove& error) {
    stop(error, "make steps shorter with --step, or pull less", progress.time * numbers.shear_rate,
         output.keep_remembered());
  } catch (const membrane::InvertedElement& error) {
    stop(error,
         stage.step > 0 ? "make steps shorter with --step, or leave it out"
                        : "a membrane that crumples needs shear elasticity, bending, or a finer or more even "
                          "mesh; one that is pulled too hard a smaller load or a shorter --step",
         progress.time * numbers.shear_rate, output.keep_remembered());
  } catch (const RunError& error) {
    stop(error, "", progress.time * numbers.shear_rate, output.keep_remembered());
  }
  fmt::print("{} steps; largest speed at the end {:.3g} radii per shear time\n", progress.n_steps,
             output.speed(motion));
}

}  // namespace

void run_stage(const DragStage& stage) {
  with_stage_errors<>([&] { run(stage); });
}

}  // namespace tanktread::driver
