// A state in parts has the bits of the whole one, and is taken over as that is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "fluid/layer_ranges.hpp"
#include "fluid/plain_lattice_boltzmann.hpp"
#include "tests/unit/fluid_support.hpp"

namespace tanktread::fluid::test::state_parts_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr GridShape box = {11, 3, 7};

/// How the box is walked through.
const std::vector<Layers> ranges = {{0, 1}, {1, 4}, {4, 4}, {4, 7}};

std::size_t numbers_of(Layers layers, int components) {
  return static_cast<std::size_t>((layers.end - layers.begin) * box.nx * box.ny * components);
}

/// The state of a solver, put together from its parts.
State from_parts(const Fluid& fluid) {
  const auto shape = fluid.state_shape();
  State state{shape.step, {}};
  for (const auto& [name, components] : shape.arrays) {
    state.arrays.push_back({name, components, {}});
    for (const Layers layers : ranges) {
      Numbers part(numbers_of(layers, components));
      fluid.state_of_layers(name, layers, part);
      auto& values = state.arrays.back().values;
      values.insert(values.end(), part.begin(), part.end());
    }
  }
  return state;
}

/// Another solver as a source, that may fail on the way.
class Source final : public StateSource {
 public:
  explicit Source(const Fluid& fluid) : fluid_(fluid) {}
  StateShape shape() const override { return fluid_.state_shape(); }
  void read(const std::string& array, Layers layers, std::span<double> values) const override {
    if (array == fails_at && layers.end == box.nz) throw std::runtime_error("no more " + array);
    fluid_.state_of_layers(array, layers, values);
  }
  void accepted() const override {
    ++n_accepted;
    if (refuses) throw std::runtime_error("another rank cannot");
  }

  std::string fails_at;
  bool refuses = false;
  mutable int n_accepted = 0;

 private:
  const Fluid& fluid_;
};

LatticeBoltzmannSettings settings_of(Storage storage, int wall_axis) {
  LatticeBoltzmannSettings settings;
  settings.shape = box;
  settings.storage = storage;
  settings.threads = 1;
  if (wall_axis >= 0) settings.walls = moving_walls(wall_axis);
  return settings;
}

/// A solver in the middle of a flow.
std::unique_ptr<Fluid> in_flow(const LatticeBoltzmannSettings& settings, int n_steps, bool with_viscosity) {
  auto fluid = make_lattice_boltzmann(settings);
  disturb(*fluid);
  if (with_viscosity) fluid->set_viscosity(random_viscosity(box));
  const auto forces = some_forces(box);
  fluid->add_force(forces.nodes, forces.force);
  steps(*fluid, n_steps);
  return fluid;
}

void for_each_flow(const std::function<void(const LatticeBoltzmannSettings&, int, bool)>& body) {
  for (const Storage storage : storages)
    for (const int wall_axis : {-1, 0, 1, 2})
      for (const int n_steps : {4, 5})  // the last one of either kind
        for (const bool with_viscosity : {false, true}) {
          SCOPED_TRACE(name_of(storage) + ", walls across " + std::to_string(wall_axis) + ", " +
                       std::to_string(n_steps) + " steps" + (with_viscosity ? ", viscosity" : ""));
          body(settings_of(storage, wall_axis), n_steps, with_viscosity);
        }
}

TEST(FluidStateParts, are_the_whole_state_and_moments) {
  for_each_flow([](const LatticeBoltzmannSettings& settings, int n_steps, bool with_viscosity) {
    const auto fluid = in_flow(settings, n_steps, with_viscosity);
    EXPECT_EQ(difference(from_parts(*fluid), fluid->state()), "");
    EXPECT_EQ(fluid->state_shape().arrays.size(), with_viscosity ? 3u : 2u);
    Moments parts;
    for (const Layers layers : ranges) {
      Numbers density(numbers_of(layers, 1)), velocity(numbers_of(layers, 3));
      fluid->moments_of_layers(layers, density, velocity);
      parts.density.insert(parts.density.end(), density.begin(), density.end());
      parts.velocity.insert(parts.velocity.end(), velocity.begin(), velocity.end());
    }
    const auto whole = moments(*fluid);
    EXPECT_EQ(parts.density, whole.density);
    EXPECT_EQ(parts.velocity, whole.velocity);
  });
}

TEST(FluidStateParts, are_taken_over_as_the_whole_state) {
  for_each_flow([](const LatticeBoltzmannSettings& settings, int n_steps, bool with_viscosity) {
    const auto from = in_flow(settings, n_steps, with_viscosity);
    const auto to = in_flow(settings, 2, !with_viscosity);
    const Source source(*from);
    to->restore_from(source);
    EXPECT_EQ(source.n_accepted, 1);
    EXPECT_EQ(difference(to->state(), from->state()), "");
    steps(*from, 3);
    steps(*to, 3);
    EXPECT_EQ(difference(to->state(), from->state()), "");
  });
}

TEST(FluidStateParts, of_a_solver_without_its_own_way) {
  const auto settings = settings_of(Storage::double_precision, 2);
  const auto from = make_plain_lattice_boltzmann(settings), to = make_plain_lattice_boltzmann(settings);
  disturb(*from);
  EXPECT_EQ(difference(from_parts(*from), from->state()), "");
  const Source source(*from);
  to->restore_from(source);
  EXPECT_EQ(source.n_accepted, 1);
  EXPECT_EQ(difference(to->state(), from->state()), "");
  Numbers density(numbers_of({2, 4}, 1)), velocity(numbers_of({2, 4}, 3));
  from->moments_of_layers({2, 4}, density, velocity);
  const auto whole = moments(*from);
  EXPECT_EQ(density, Numbers(&whole.density[numbers_of({0, 2}, 1)], &whole.density[numbers_of({0, 4}, 1)]));
  EXPECT_EQ(velocity,
            Numbers(&whole.velocity[numbers_of({0, 2}, 3)], &whole.velocity[numbers_of({0, 4}, 3)]));
  EXPECT_THROW(from->state_of_layers("force", {6, 8}, velocity), std::invalid_argument);
  EXPECT_THROW(from->state_of_layers("temperature", {2, 4}, velocity), std::invalid_argument);
  EXPECT_THROW(from->state_of_layers("force", {2, 4}, density), std::invalid_argument);
  EXPECT_THROW(from->moments_of_layers({2, 4}, velocity, density), std::invalid_argument);
}

TEST(FluidStateParts, leave_the_solver_as_it_was_if_they_are_refused) {
  const auto settings = settings_of(Storage::double_precision, -1);
  const auto from = in_flow(settings, 3, true), to = in_flow(settings, 2, false);
  const auto before = to->state();
  Source source(*from);
  source.refuses = true;
  EXPECT_THROW(to->restore_from(source), std::runtime_error);
  EXPECT_EQ(difference(to->state(), before), "");
  source.refuses = false;
  source.fails_at = "viscosity";  // which is looked at before all else
  EXPECT_THROW(to->restore_from(source), std::runtime_error);
  EXPECT_EQ(difference(to->state(), before), "");
  EXPECT_EQ(source.n_accepted, 1);
  source.fails_at = "populations";  // too late for that; but another state is taken over
  EXPECT_THROW(to->restore_from(source), std::runtime_error);
  to->restore(before);
  EXPECT_EQ(difference(to->state(), before), "");
}

/// A state with one thing changed.
class Changed final : public StateSource {
 public:
  explicit Changed(StateShape shape) : shape_(std::move(shape)) {}
  StateShape shape() const override { return shape_; }
  void read(const std::string& array, Layers layers, std::span<double> values) const override {
    std::ranges::fill(values, 0.1);
    if (array == "viscosity" && layers.end == box.nz) values.back() = 0;
  }

 private:
  StateShape shape_;
};

TEST(FluidStateParts, are_checked_before_anything_changes) {
  const auto fluid = in_flow(settings_of(Storage::double_precision, -1), 2, false);
  const auto before = fluid->state();
  const auto refusal = [&](const StateShape& shape) -> std::string {
    try {
      fluid->restore_from(Changed(shape));
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(difference(fluid->state(), before), "");
      return error.what();
    }
    return "";
  };
  const StateArrayShape populations = {"populations", 19}, force = {"force", 3}, viscosity = {"viscosity", 1};
  EXPECT_THAT(refusal({-1, {populations, force}}), HasSubstr("step is -1"));
  EXPECT_THAT(refusal({1, {force}}), HasSubstr("no array 'populations'"));
  EXPECT_THAT(refusal({1, {populations}}), HasSubstr("no array 'force'"));
  EXPECT_THAT(refusal({1, {{"populations", 18}, force}}), HasSubstr("18 components; 19 are needed"));
  EXPECT_THAT(refusal({1, {populations, force, {"heat", 1}}}), HasSubstr("'heat'"));
  EXPECT_THAT(refusal({1, {populations, force, viscosity}}), HasSubstr("viscosity of node 230 is 0"));
  EXPECT_EQ(refusal({1, {populations, force}}), "");
}

TEST(FluidLayerRanges, are_all_layers_in_turn) {
  const auto ends = [](std::int64_t nodes_a_layer, int n_layers, int components) {
    std::vector<int> found;
    for_layer_ranges(nodes_a_layer, n_layers, components, [&](Layers layers) {
      EXPECT_EQ(layers.begin, found.empty() ? 0 : found.back());
      found.push_back(layers.end);
    });
    return found;
  };
  EXPECT_THAT(ends(10, 5, 1), ElementsAre(5));
  EXPECT_THAT(ends(1 << 18, 5, 1), ElementsAre(2, 4, 5));
  EXPECT_THAT(ends(1 << 18, 2, 19), ElementsAre(1, 2));
  EXPECT_THAT(ends(10, 0, 1), ElementsAre());
}

}  // namespace
}  // namespace tanktread::fluid::test::state_parts_test
