#include "driver/engine/many_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "driver/engine/capsule_orders.hpp"
#include "driver/engine/part_answers.hpp"
#include "driver/engine/part_files.hpp"
#include "driver/packets/fluid_files.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/file_ending.hpp"
#include "driver/system/fluid_output.hpp"
#include "driver/system/part_orders.hpp"
#include "driver/system/run_ranks.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

/// What a rank answers, for each of the others in turn.
template <class Take>
void for_all_answers(const ranks::World& world, const Take& take) {
  for (int rank = 1; rank < world.size(); ++rank) {
    ranks::Unpacking answer(world.receive(rank));
    take(rank, answer);
  }
}

std::vector<PartCapsule> at_start(const MembraneShapes& shapes) {
  std::vector<PartCapsule> capsules;
  for (std::size_t k = 0; k < shapes.meshes.size(); ++k)
    capsules.push_back({k, shapes.meshes[k], shapes.stress_free[k], std::nullopt});
  return capsules;
}

}  // namespace

ManyRanks::ManyRanks(const Case& the_case, const Parameters& parameters)
    : case_(the_case),
      shear_rate_(parameters.shear_rate),
      has_iterations_(any_implicit(the_case, parameters)),
      fluid_(make_fluid_on_ranks(the_case, parameters)),
      world_(fluid_->world()) {
  auto message = order(Order::make_system);
  pack(message, the_case);
  tell_others(world_, message.bytes());
  own_.emplace(world_, fluid_->division(), fluid_->own_part(), the_case, parameters);
}

ManyRanks::~ManyRanks() {
  tell_others(world_, order(Order::give_up_system).bytes());
}

/// The error that one rank would have met first.
std::optional<StepError> ManyRanks::first_error(const PartStep& own) const {
  if (own.all_well) return std::nullopt;
  auto first = own.error;
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    auto error = take_error(answer);
    if (error && (!first || error->is_before(*first))) first = std::move(error);
  });
  return first;
}

std::optional<StepError> ManyRanks::begin_at(std::int64_t step, std::vector<PartCapsule> capsules) {
  step_ = step;
  tell_others(world_, order(Order::begin).put(step).bytes());
  return first_error(own_->begin(step, std::move(capsules)));
}

void ManyRanks::begin(const MembraneShapes& shapes) {
  const auto error = shapes.meshes.empty() ? begin_from_case() : begin_at(0, at_start(shapes));
  if (!error) return;
  if (error->phase == StepPhase::restore) throw InputError(error->message);
  throw InputError(fmt::format("{}; move the capsule (capsule.N.position){}", error->message,
                               error->phase == StepPhase::stencils ? " or enlarge flow.box" : ""));
}

/// Each rank makes some shapes.
std::optional<StepError> ManyRanks::begin_from_case() {
  step_ = 0;
  tell_others(world_, order(Order::begin_from_case).bytes());
  auto made = make_capsules(world_, case_);
  return first_error(own_->begin(0, std::move(made.capsules), made.error));
}

std::optional<StepError> ManyRanks::begin_from_pieces(const SavedState& state) {
  step_ = state.step;
  tell_others(
      world_,
      order(Order::begin_from_pieces).put(state.step).put_text(state.membrane_pieces.string()).bytes());
  auto read = read_capsules(world_, state.membrane_pieces, case_.capsules.size());
  if (!read.all_well) {
    auto error = read.error;
    for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
      auto text = answer.take_text();
      if (error.empty()) error = std::move(text);
    });
    throw exchange::FileError(error);
  }
  return first_error(own_->begin(state.step, std::move(read.capsules)));
}

void ManyRanks::restore(const SavedState& state) {
  const auto folder = state.folder.string();
  const bool in_pieces = !state.membrane_pieces.empty();
  if (!in_pieces && state.positions.size() != case_.capsules.size()) {
    throw InputError(fmt::format("{}: {} capsules, the case has {}", folder, state.positions.size(),
                                 case_.capsules.size()));
  }
  try {
    restore_fluid(*fluid_, state);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: does not fit the case: {}", folder, error.what()));
  }
  const auto error =
      in_pieces ? begin_from_pieces(state)
                : begin_at(state.step, part_capsules({0, state.shapes, state.positions, state.node_velocity,
                                                      state.node_force, state.membranes}));
  if (!error) return;
  const char* what = error->phase == StepPhase::restore ? "does not fit the case: " : "";
  throw InputError(fmt::format("{}: {}{}", folder, what, error->message));
}

void ManyRanks::advance() {
  tell_others(world_, order(Order::advance).bytes());
  const auto step = own_->advance();
  if (const auto error = first_error(step))
    throw RunError(error->says_step ? error->message : fmt::format("step {}: {}", step_ + 1, error->message));
  highest_speed_ = step.highest_speed;
  viscous_iterations_ = step.viscous_iterations;
  ++step_;
}

void ManyRanks::share_out() {
  tell_others(world_, order(Order::share_out).bytes());
  own_->share_out();
}

std::vector<Observation> ManyRanks::observe() {
  tell_others(world_, order(Order::observe).bytes());
  std::optional<int> iterations;
  if (has_iterations_) iterations = viscous_iterations_;
  auto observations = driver::observe(own_->capsules(), case_, highest_speed_, iterations);
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    for (auto& observation : answer.take_all<Observation>()) {
      observation.max_speed = highest_speed_;
      observation.viscous_iterations = iterations;
      observations.push_back(observation);
    }
  });
  std::ranges::sort(observations, {}, &Observation::capsule);
  return observations;
}

std::vector<std::string> ManyRanks::measures_rows() {
  tell_others(world_, order(Order::measures).bytes());
  auto rows = driver::measures_rows(*own_);
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    for (auto& row : take_rows(answer)) rows.push_back(std::move(row));
  });
  std::ranges::sort(rows, {}, &CapsuleRow::capsule);
  std::vector<std::string> texts;
  for (auto& row : rows) texts.push_back(std::move(row.text));
  return texts;
}

EnergyBudget ManyRanks::energy_budget() {
  tell_others(world_, order(Order::energy).bytes());
  auto all = energy_of(*own_, fluid_->own_part());
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    auto energy = take_energy(answer);
    if (energy.error && (!all.error || energy.error->is_before(*all.error)))
      all.error = std::move(energy.error);
    for (auto& membrane : energy.membranes) all.membranes.push_back(std::move(membrane));
    all.flow.add(energy.flow);
  });
  if (all.error) throw RunError(fmt::format("step {}: {}", step_, all.error->message));
  std::ranges::sort(all.membranes, {}, [](const auto& membrane) { return membrane.first; });
  std::vector<MembraneBudget> membranes;
  for (auto& [number, budget] : all.membranes) membranes.push_back(std::move(budget));
  return driver::energy_budget(step_, shear_time(), membranes, all.flow);
}

void ManyRanks::write_surfaces(const fs::path& file, bool is_state) {
  const SurfacesToWrite what{file, is_state, most_triangles(case_, FileSizes::by_case)};
  auto message = order(Order::write_surfaces);
  pack(message, what);
  tell_others(world_, message.bytes());
  auto written = driver::write_surfaces(*own_, what);
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    auto error = answer.take_text();
    if (written.error.empty()) written.error = std::move(error);
  });
  if (!written.error.empty()) throw exchange::FileError(written.error);
  if (written.n_pieces > 1) write_index_of_pieces(file, written.first.value(), written.n_pieces);
}

void ManyRanks::write_membranes(const fs::path& file) {
  write_surfaces(file, false);
}

void ManyRanks::write_pieces(const PiecesOrder& what) {
  auto message = order(Order::write_pieces);
  pack(message, what);
  tell_others(world_, message.bytes());
  auto written = write_piece(
      {world_, fluid_->division(), fluid_->own_part(), fluid_->base_viscosity(), own_->marks()}, what);
  for_all_answers(world_, [&](int, ranks::Unpacking& answer) {
    auto error = answer.take_text();
    if (written.error.empty()) written.error = std::move(error);
  });
  if (!written.error.empty()) throw exchange::FileError(written.error);
  write_index(fluid_->division(), what, written);
}

/// Of the box; empty: the fluid has one viscosity.
std::vector<std::int32_t> ManyRanks::gathered_marks() const {
  if (own_->marks().empty()) return {};
  tell_others(world_, order(Order::marks).bytes());
  const auto& division = fluid_->division();
  std::vector<double> marks(static_cast<std::size_t>(fluid_->shape().size()));
  const auto place = [&](std::span<const std::int32_t> of_block, int rank) {
    const std::vector<double> numbers(of_block.begin(), of_block.end());
    place_block(numbers, 1, division, rank, marks);
  };
  place(own_->marks(), 0);
  for_all_answers(world_,
                  [&](int rank, ranks::Unpacking& answer) { place(answer.take_all<std::int32_t>(), rank); });
  return {marks.begin(), marks.end()};
}

void ManyRanks::write_flow(const fs::path& file) {
  const auto& range = case_.output.fluid_box;
  if (has_large_box(case_)) {
    return write_pieces({with_ending(file, ".pvti"), range.value_or(whole_range(case_.flow.box)), false,
                         step_, shear_time()});
  }
  exchange::write_grid(with_ending(file, ".vti"),
                       flow_file(*fluid_, range, step_, shear_time(), gathered_marks()));
}

void ManyRanks::write_state(const fs::path& folder) {
  fs::create_directories(folder);
  const auto fluid_file = folder / fs::path(fluid_state_file).stem();
  if (has_large_box(case_)) {
    write_pieces({with_ending(fluid_file, ".pvti"), whole_range(case_.flow.box), true, step_, shear_time()});
  } else {
    write_fluid_state(*fluid_, false, fluid_file);
  }
  write_surfaces(folder / fs::path(membrane_state_file).stem(), true);
  exchange::write_text(folder / case_state_file, to_toml(case_));
}

}  // namespace tanktread::driver
