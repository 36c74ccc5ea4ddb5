#include "driver/engine/system_part.hpp"

#include <omp.h>

#include <cmath>
#include <limits>
#include <utility>

#include "coupler/volume.hpp"
#include "driver/system/components.hpp"
#include "driver/system/inside_fluid.hpp"
#include "driver/system/node_spans.hpp"
#include "driver/system/timer.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

coupler::GridPart grid_part(const ranks::Division& division, int rank) {
  const auto block = division.block(rank);
  return {block.begin, block.n};
}

/// Grid steps from a node at which it may touch a grid node, or be in its cell.
int reach_of(const coupler::Kernel& kernel) {
  return static_cast<int>(std::ceil(kernel.half_width)) + 1;
}

}  // namespace

SystemPart::SystemPart(const ranks::World& world, const ranks::Division& division, fluid::Fluid& fluid,
                       const Case& the_case, const Parameters& parameters)
    : world_(world),
      fluid_(fluid),
      case_(the_case),
      parameters_(parameters),
      part_(grid_part(division, world.rank())),
      coupler_(coupler_grid(the_case), part_, coupler::kernel(the_case.coupler.kernel), the_case.run.threads),
      corrections_(make_node_corrections(the_case, coupler_)),
      implicit_(implicit_settings(the_case)),
      is_implicit_(any_implicit(the_case, parameters)),
      threads_(the_case.run.threads > 0 ? the_case.run.threads : omp_get_max_threads()),
      places_(division),
      messages_(world, division, reach_of(coupler_.kernel())),
      halo_(world, division, coupler_.region()) {
  if (!has_contrast(the_case)) return;
  inside_ = std::make_unique<coupler::InsideMarks>(coupler_grid(the_case), part_, the_case.run.threads);
  viscosity_of_marks_ = viscosities_of_marks(the_case);
}

SystemPart::~SystemPart() = default;

void SystemPart::find_stencils() {
  build_stencils(coupler_, corrections_, near_.surfaces.positions, near_.surfaces.triangles);
}

// After a restore the fluid's state has the viscosities already; to set them again changes nothing.
void SystemPart::mark_inside(bool anew) {
  const auto news = driver::mark_inside(*inside_, near_.surfaces.positions, near_.surfaces.triangles, anew);
  set_viscosity(fluid_, news, viscosity_of_marks_);
}

PartStep SystemPart::advance() {
  FirstError error;
  PartStep result;
  advance_phases(error, result);
  result.error = error.error();
  return result;
}

void SystemPart::advance_phases(FirstError& error, PartStep& result) {
  constexpr double failed = std::numeric_limits<double>::infinity();
  find_node_velocities(error);
  move_membranes(error);
  timed(seconds_.messages, [&] { messages_.send_surfaces(own_, near_); });
  error.guard(StepPhase::stencils, [&] { timed(seconds_.stencils, [&] { find_stencils(); }); });
  // From here on ranks answer each other by what all of them have found.
  result.all_well = timed(seconds_.messages, [&] { return world_.highest(error.error() ? 1 : 0) == 0; });
  if (!result.all_well) return;
  timed(seconds_.messages, [&] { halo_.find(coupler_.grid_nodes()); });
  if (is_implicit_) add_implicit(error, result);
  force_fluid();
  if (inside_) error.guard(StepPhase::inside, [&] { timed(seconds_.inside, [&] { mark_inside(false); }); });
  double speed = 0;
  FirstError of_flow;  // the fluid's step is made in any case, for its neighbours wait for it
  of_flow.guard(StepPhase::flow, [&] { speed = timed(seconds_.fluid, [&] { return fluid_.step(); }); });
  error.take(of_flow);
  result.highest_speed =
      timed(seconds_.messages, [&] { return world_.highest(error.error() ? failed : speed); });
  result.all_well = result.highest_speed != failed;
  ++step_;
}

// 1., and the first part of 2.: of the nodes at home.
void SystemPart::interpolate() {
  const std::size_t n_nodes = coupler_.grid_nodes().size();
  on_grid_.resize(3 * n_nodes);
  timed(seconds_.forced_nodes, [&] {
    of_own_.resize(3 * halo_.own_nodes().size());
    fluid_.velocity(halo_.own_nodes(), of_own_);
    halo_.place_own(of_own_, 3, on_grid_);
  });
  timed(seconds_.messages, [&] { halo_.complete(3, on_grid_); });
  timed(seconds_.interpolation, [&] { coupler_.interpolate(on_grid_, targets_of(near_.velocity)); });
}

// 1. and 2.
void SystemPart::find_node_velocities(FirstError& error) {
  interpolate();
  correct_along_membranes(error, near_.force, near_.velocity);
  bring_velocities(own_.velocity);
  timed(seconds_.correction, [&] { keep_volume(own_.velocity); });
}

void SystemPart::keep_volume(NodeVectors& velocity) const {
  for (std::size_t k = 0; corrections_.keeps_volume && k < velocity.size(); ++k)
    coupler::keep_volume(numbers_of(own_.positions[k]), numbers_of(own_.triangles[k]),
                         {velocity[k].data(), static_cast<std::size_t>(velocity[k].size())});
}

NodeVelocities SystemPart::node_velocities(FirstError& error) {
  const StepSeconds before = seconds_;  // this is no part of a step
  NodeVelocities velocities{zero_like(own_.positions), zero_like(own_.positions)};
  interpolate();
  bring_velocities(velocities.interpolated);
  correct_along_membranes(error, near_.force, near_.velocity);
  bring_velocities(velocities.corrected);
  keep_volume(velocities.corrected);
  seconds_ = before;
  return velocities;
}

std::vector<std::int32_t> SystemPart::marks_now() {
  if (inside_) return {inside_->marks().begin(), inside_->marks().end()};
  coupler::InsideMarks marks(coupler_grid(case_), part_, threads_);
  marks.mark(views(near_.surfaces.positions), corners_of(near_.surfaces.triangles));
  return {marks.marks().begin(), marks.marks().end()};
}

void SystemPart::bring_velocities(NodeVectors& velocity) {
  timed(seconds_.messages, [&] {
    std::vector<std::span<const std::int32_t>> home;
    for (std::size_t k = 0; k < near_.velocity.size(); ++k) home.push_back(coupler_.home_nodes(k));
    messages_.bring_velocities(near_.velocity, home, velocity);
  });
}

void SystemPart::correct_along_membranes(FirstError& error, const NodeVectors& force, NodeVectors& velocity) {
  if (!corrections_.along_membrane) return;
  const auto& correction = *corrections_.along_membrane;
  const auto normals = timed(seconds_.correction, [&] {
    return corrections_.normals->find(views(near_.surfaces.positions), corners_of(near_.surfaces.triangles));
  });
  error.guard(StepPhase::correction, [&] {
    timed(seconds_.correction, [&] { correction.spread(coupler_, normals, views(force), on_grid_); });
  });
  timed(seconds_.messages, [&] { halo_.complete(3, on_grid_); });
  timed(seconds_.correction, [&] { correction.add_from(coupler_, normals, on_grid_, targets_of(velocity)); });
}

// 3. and 4.
void SystemPart::move_membranes(FirstError& error) {
  timed(seconds_.membranes, [&] {
    error.guard(StepPhase::move, [&] {
      auto next = move_nodes(own_.positions, own_.velocity, threads_, std::move(scratch_), own_.numbers);
      scratch_ = std::exchange(own_.positions, std::move(next));
    });
    error.guard(StepPhase::forces, [&] {
      auto next = nodal_forces(membranes_, own_.positions, own_.velocity, step_ + 1,
                               std::move(scratch_force_), own_.numbers);
      scratch_force_ = std::exchange(own_.force, std::move(next));
    });
  });
}

// 7., and the first part of 9.
void SystemPart::force_fluid() {
  on_grid_.resize(3 * coupler_.grid_nodes().size());
  timed(seconds_.spreading, [&] { coupler_.spread(views(near_.force), on_grid_); });
  timed(seconds_.forced_nodes, [&] {
    halo_.take_own(on_grid_, 3, of_own_);
    fluid_.clear_force();
    fluid_.add_force(halo_.own_nodes(), of_own_);
  });
}

/// What the equations of implicit viscosities ask of coupler and fluid, by all ranks together.
class SystemPart::Mobility final : public NodeMobility {
 public:
  explicit Mobility(SystemPart& part, FirstError& error) : part_(part), error_(error) {}

  void velocity_of(const NodeVectors& force, bool with_free, NodeVectors& velocity) override {
    auto& near = part_.near_;
    part_.messages_.send_forces(force, near.force);
    auto& on_grid = part_.on_grid_;
    on_grid.resize(3 * part_.coupler_.grid_nodes().size());
    part_.coupler_.spread(views(near.force), on_grid);
    move_freely(part_.free_, with_free, part_.threads_, on_grid);
    part_.halo_.complete(3, on_grid);
    part_.coupler_.interpolate(on_grid, targets_of(near.velocity));
    part_.correct_along_membranes(error_, near.force, near.velocity);
    part_.bring_velocities(velocity);
  }

  double sum(std::span<const double> of_membranes) const override {
    const auto all = part_.world_.all_numbers(of_membranes);
    double sum = 0;
    for (const std::size_t place : part_.order_) sum += all[place];
    return sum;
  }

 private:
  SystemPart& part_;
  FirstError& error_;
};

// 6.
void SystemPart::add_implicit(FirstError& error, PartStep& result) {
  const StepSeconds before = seconds_;  // what the parts of this one add is in it
  double seconds = 0;
  timed(seconds, [&] {
    const std::size_t n_nodes = coupler_.grid_nodes().size();
    free_.values.assign(3 * n_nodes, 0);
    free_.mobility.assign(n_nodes, 0);
    std::vector<double> mobility(halo_.own_nodes().size());
    of_own_.resize(3 * mobility.size());
    fluid_.free_velocity(halo_.own_nodes(), of_own_, mobility);
    halo_.place_own(of_own_, 3, free_.values);
    halo_.place_own(mobility, 1, free_.mobility);
    Mobility of_nodes(*this, error);
    // All ranks see the same sums, and so the same end.
    error.guard(StepPhase::implicit_forces, [&] {
      result.viscous_iterations = add_implicit_forces(membranes_, of_nodes, implicit_, own_.force);
    });
    messages_.send_forces(own_.force, near_.force);
  });
  seconds_ = before;
  seconds_.implicit += seconds;
}

}  // namespace tanktread::driver
