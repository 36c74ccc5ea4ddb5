// Which capsules a rank has: at the start, and when they have moved on.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "driver/engine/capsule_orders.hpp"
#include "driver/engine/system_part.hpp"
#include "driver/system/components.hpp"
#include "driver/units/laws.hpp"

namespace tanktread::driver {
namespace {

/// A case, or its parameters, with some of the capsules alone.
template <class OfCapsules>
OfCapsules with_capsules(const OfCapsules& all, std::span<const std::size_t> numbers) {
  OfCapsules result = all;
  result.capsules.clear();
  for (const std::size_t number : numbers) result.capsules.push_back(all.capsules[number]);
  return result;
}

NearCapsules nothing_near(std::size_t n_capsules) {
  const NodeVectors none(n_capsules, Eigen::Matrix3Xd(3, 0));
  return {{none, std::vector<Eigen::Matrix3Xi>(n_capsules, Eigen::Matrix3Xi(3, 0))}, none, none};
}

/// The same elements in another order. @param order where the new ones were
template <class Element>
void reorder(const std::vector<std::size_t>& order, std::vector<Element>& elements) {
  std::vector<Element> result;
  result.reserve(elements.size());
  for (const std::size_t k : order) result.push_back(std::move(elements[k]));
  elements = std::move(result);
}

const Eigen::Matrix3Xd& positions_of(const PartCapsule& capsule) {
  return capsule.state ? capsule.state->positions : capsule.start.points;
}

}  // namespace

int SystemPart::owner_of(const Eigen::Matrix3Xd& positions) const {
  const Eigen::Vector3d middle = positions.rowwise().mean();
  ranks::Triple part;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = places_.n_nodes()[axis];
    const double coordinate =
        places_.is_periodic(axis) ? middle[axis] - n * std::floor(middle[axis] / n) : middle[axis];
    part[axis] = places_.part_of(axis, std::clamp(static_cast<int>(coordinate), 0, n - 1));
  }
  return places_.rank_of(part);
}

/// @return those that this rank owns, of all ranks'
std::vector<PartCapsule> SystemPart::brought_to_owners(std::vector<PartCapsule> capsules) const {
  std::vector<PartCapsule> own;
  std::vector<ranks::Packing> letters(static_cast<std::size_t>(world_.size()));
  for (auto& capsule : capsules) {
    const int owner = owner_of(positions_of(capsule));
    if (owner == world_.rank()) {
      own.push_back(std::move(capsule));
      continue;
    }
    letters[static_cast<std::size_t>(owner)].put(true);
    pack(letters[static_cast<std::size_t>(owner)], capsule);
    capsule = {};  // it is in the letter now
  }
  std::vector<ranks::Message> messages;
  for (int rank = 0; rank < world_.size(); ++rank) {
    auto& letter = letters[static_cast<std::size_t>(rank)];
    if (letter.bytes().empty()) continue;
    letter.put(false);
    messages.push_back({rank, letter.take_bytes()});
  }
  for (auto& message : world_.exchange(std::move(messages))) {
    ranks::Unpacking letter(std::move(message.bytes));
    while (letter.take<bool>()) own.push_back(take_capsule(letter));
  }
  return own;
}

/// One of its own, as it goes to another rank.
PartCapsule SystemPart::given_away(std::size_t k) const {
  const auto& membrane = membranes_[k];
  return {own_.numbers[k],
          {membrane.start(), own_.triangles[k]},
          membrane.reference().points,
          PartCapsule::State{own_.positions[k], own_.velocity[k], own_.force[k], membrane.state().history}};
}

/// Adds capsules to its own.
void SystemPart::keep(std::vector<PartCapsule> capsules, FirstError& error) {
  std::vector<std::size_t> numbers;
  MembraneShapes shapes;
  for (auto& capsule : capsules) {
    numbers.push_back(capsule.number);
    shapes.meshes.push_back(std::move(capsule.start));
    shapes.stress_free.push_back(std::move(capsule.stress_free));
  }
  std::vector<CapsuleMembrane> made;
  try {
    if (!capsules.empty())
      made = make_membranes(with_capsules(case_, numbers), with_capsules(parameters_, numbers), shapes);
  } catch (const std::invalid_argument& mismatch) {  // of a shape that is no membrane's
    return error.keep({StepPhase::restore, numbers[0], false, mismatch.what()});
  }
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    auto& membrane = made[k];
    const Eigen::Matrix3Xd zero = Eigen::Matrix3Xd::Zero(3, membrane.n_nodes());
    auto state =
        std::move(capsules[k].state).value_or(PartCapsule::State{membrane.positions(), zero, zero, {}});
    if (capsules[k].state) {
      try {
        membrane.set_positions(state.positions);
        membrane.restore({std::move(state.history), {}});
      } catch (const std::invalid_argument& mismatch) {
        error.keep({StepPhase::restore, numbers[k], false, mismatch.what()});
      }
    }
    own_.numbers.push_back(numbers[k]);
    own_.triangles.push_back(membrane.reference().triangles);
    own_.positions.push_back(std::move(state.positions));
    own_.velocity.push_back(std::move(state.velocity));
    own_.force.push_back(std::move(state.force));
    membranes_.push_back(std::move(membrane));
  }
  std::vector<std::size_t> order(own_.numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return own_.numbers[k]; });
  reorder(order, own_.numbers);
  reorder(order, own_.triangles);
  for (auto* vectors : {&own_.positions, &own_.velocity, &own_.force}) reorder(order, *vectors);
  reorder(order, membranes_);
}

/// What all ranks know of all capsules.
void SystemPart::count_capsules() {
  std::vector<double> own;
  for (std::size_t k = 0; k < own_.numbers.size(); ++k) {
    own.push_back(static_cast<double>(own_.numbers[k]));
    own.push_back(static_cast<double>(own_.triangles[k].cols()));
  }
  const auto of_all = world_.all_numbers(own);
  order_.assign(case_.capsules.size(), 0);
  n_triangles_.assign(case_.capsules.size(), 0);
  for (std::size_t place = 0; 2 * place < of_all.size(); ++place) {
    const auto number = static_cast<std::size_t>(of_all[2 * place]);
    order_[number] = place;
    n_triangles_[number] = static_cast<std::int64_t>(of_all[2 * place + 1]);
  }
}

PartStep SystemPart::begin(std::int64_t step, std::vector<PartCapsule> capsules,
                           const std::optional<StepError>& given_error) {
  FirstError error;
  if (given_error) error.keep(*given_error);
  step_ = step;
  own_ = {};
  membranes_.clear();
  keep(brought_to_owners(std::move(capsules)), error);
  const auto arrays = arrays_of(membranes_);
  arrays_.terms = term_names(parameters_);
  arrays_.has_loads = world_.highest(arrays.has_loads ? 1 : 0) > 0;
  arrays_.starts_elsewhere = world_.highest(arrays.starts_elsewhere ? 1 : 0) > 0;
  auto result = settle(error);
  if (!result.all_well || !inside_) return result;
  error.guard(StepPhase::inside, [&] { mark_inside(true); });
  result.all_well = world_.highest(error.error() ? 1 : 0) == 0;
  result.error = error.error();
  return result;
}

void SystemPart::share_out() {
  std::vector<PartCapsule> leaving;
  std::vector<std::size_t> staying;
  for (std::size_t k = 0; k < own_.numbers.size(); ++k) {
    if (owner_of(own_.positions[k]) == world_.rank()) {
      staying.push_back(k);
    } else {
      leaving.push_back(given_away(k));
    }
  }
  if (world_.highest(leaving.empty() ? 0 : 1) == 0) return;
  reorder(staying, own_.numbers);
  reorder(staying, own_.triangles);
  for (auto* vectors : {&own_.positions, &own_.velocity, &own_.force}) reorder(staying, *vectors);
  reorder(staying, membranes_);
  FirstError error;
  keep(brought_to_owners(std::move(leaving)), error);
  if (settle(error).all_well) return;
  throw std::logic_error("capsules that were well are not so at their new owners");
}

/// What follows from who has which capsules, and where they are.
PartStep SystemPart::settle(FirstError& error) {
  PartStep result;
  result.all_well = world_.highest(error.error() ? 1 : 0) == 0;
  result.error = error.error();
  if (!result.all_well) return result;
  count_capsules();
  near_ = nothing_near(case_.capsules.size());
  messages_.forget();
  messages_.send_surfaces(own_, near_);
  error.guard(StepPhase::stencils, [&] { find_stencils(); });
  result.all_well = world_.highest(error.error() ? 1 : 0) == 0;
  result.error = error.error();
  if (result.all_well) halo_.find(coupler_.grid_nodes());
  return result;
}

}  // namespace tanktread::driver
